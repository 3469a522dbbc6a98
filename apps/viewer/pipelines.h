#pragma once

#include "window_device.h"

#include <map>
#include <tuple>
#include <utility>

#include <glm/mat4x4.hpp>

/// What shaders are told for each drawing.
struct Push
{
    glm::mat4 clipFromWorld{1.0f};
    float exposure = 1.0f; // factor on light
};

/// The same for the sky.
struct SkyPush
{
    glm::mat4 worldFromClip{1.0f};
    glm::vec3 radiance{0.0f}; // multiplies its picture
    float turn = 0.0f;        // rad
    float exposure = 1.0f;
};

/// What is drawn.
enum class Subject {
    room,
    lamp, // the surface of a light, and no layer
    sky   // what is seen past all else
};

/// How a piece of the picture is drawn; each way has a pipeline, made when it is first asked for.
struct Drawing
{
    int layer = 0; // shaders/layers.glsl
    int view = 0;  // standard, AgX, ACES; 3: light itself
    bool ofVertices = false;
    bool atlas = false;
    bool lines = false;
    Subject subject = Subject::room;

    auto operator<=>(const Drawing&) const = default;
};

/// The pipelines of one render pass.
class Pipelines
{
public:
    Pipelines(const WindowDevice& device, VkDescriptorSetLayout layers);

    /// `pass` is what it will be drawn in.
    VkPipeline of(const Drawing& drawing, VkRenderPass pass);
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }

private:
    /// That of its corners, and that of its pixels.
    [[nodiscard]] std::pair<VkShaderModule, VkShaderModule> shadersOf(Subject subject) const;
    [[nodiscard]] relamp::gpu::Owned<VkPipeline> make(const Drawing& drawing,
                                                      VkRenderPass pass) const;

    const WindowDevice& device_;
    relamp::gpu::Owned<VkShaderModule> roomVertex_, roomFragment_, lampVertex_, lampFragment_,
        skyVertex_, skyFragment_;
    relamp::gpu::Owned<VkPipelineLayout> layout_;
    std::map<std::pair<VkRenderPass, Drawing>, relamp::gpu::Owned<VkPipeline>> made_;
};
