#pragma once

#include "input.h"
#include "window_device.h"

#include <string>

class Window;

/// Dear ImGui in the viewer's window: its input, its look, its drawing.
class PanelDrawing
{
public:
    PanelDrawing(const WindowDevice& device, Window& window, VkRenderPass pass);
    ~PanelDrawing();
    PanelDrawing(const PanelDrawing&) = delete;
    PanelDrawing& operator=(const PanelDrawing&) = delete;

    static void take(const InputEvent& event);
    /// Begins a frame of this size; panels may be described until `draw`.
    static void begin(glm::ivec2 pixels, float seconds);
    /// Ends the frame's description and keeps it to be drawn.
    static void end();
    static void draw(VkCommandBuffer commands);

private:
    void dress(float scale);

    const WindowDevice& device_;
    relamp::gpu::Owned<VkDescriptorPool> pool_;
    std::string clipboard_;
};
