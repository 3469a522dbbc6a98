#pragma once

#include "gizmo.h"
#include "panel_drawing.h"
#include "room_drawing.h"
#include "settings.h"
#include "studio.h"
#include "swapchain.h"
#include "target.h"
#include "window.h"
#include "window_device.h"

#include "relamp/image.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// Places to open and save at, as they were typed.
struct Paths
{
    std::string open;
    std::string lights = "lights.json";
    std::string result = "result";
    std::string baked = "relit.glb";
    std::string page = "page";
    std::string picture = "picture.png";
};

/// What is shown, beside the room's own state.
struct Shown
{
    Paths paths;
    Layer layer = Layer::scan;
    Layer before = Layer::scan; // left of the slider
    bool compares = false;
    float slider = 0.5f; // of the view's width
    bool wireframe = false;
    bool atlas = false;
    glm::vec2 atlasCentre{0.5f};
    float atlasZoom = 1.0f; // heights of the view a unit of the atlas
    bool panels = true;
    bool help = false;
    bool marks = true;      // lights and gizmo
    bool isEditing = false; // something of a panel is held
    bool inPanels = false;  // keys go to the panels
};

class ScriptRunner;

/// The program: a window on a studio.
class Viewer
{
public:
    struct Options
    {
        std::filesystem::path path; // what to open; empty: nothing
        relamp::ScanOptions scan;
        std::filesystem::path script; // empty: a person
        std::optional<glm::ivec2> size;
        Smooth smooth = Smooth::automatic;
        relamp::EngineOptions engine; // that computes; its GPU draws, too
    };
    explicit Viewer(const Options& options);
    ~Viewer();

    /// Until the window is closed.
    void run();
    void quit() { isQuitting_ = true; }

    /// Writes what the window shows, or the view without panels and marks: .png, or .exr of the
    /// light itself. Throws relamp::Error.
    void screenshot(const std::filesystem::path& file, bool onlyView);

    /// The view's part of the window, in pixels, and its shape.
    [[nodiscard]] VkRect2D frame() const;
    [[nodiscard]] float aspect() const;
    [[nodiscard]] Gizmo::Eye eye() const;
    [[nodiscard]] glm::vec2 inFrame(glm::vec2 pixel) const; // of the window
    [[nodiscard]] float scale() const { return scale_; }
    [[nodiscard]] const WindowDevice& device() const { return device_; }
    [[nodiscard]] Window& window() { return window_; }
    [[nodiscard]] bool isHeld(int key) const { return heldKeys_.contains(key); }
    [[nodiscard]] size_t framesDrawn() const { return framesDrawn_; }
    [[nodiscard]] bool has(Layer layer) const { return drawing_.has(layer); }
    /// What is shown in place of a layer that has not come.
    [[nodiscard]] Layer available(Layer layer) const;

    void select(const Selection& selection);
    /// What the gizmo holds, where something is selected.
    [[nodiscard]] std::optional<Aimed> selectedLight() const;
    void setSelectedLight(const Aimed& light, const std::string& step);

    Settings settings;

private:
    Window window_;
    WindowDevice device_;
    Target target_;
    Swapchain swapchain_;
    PanelDrawing panels_;
    RoomDrawing drawing_;
    std::unique_ptr<Target> still_; // for EXR, of half floats
    float scale_ = 1.0f;

public:
    Studio studio;
    Shown shown;
    Gizmo gizmo;

private:
    void takeAll(const std::vector<InputEvent>& events);
    void stepScript();
    void failIfNotOpened();
    void take(const InputEvent& event);
    void takeKey(const InputEvent& event);
    void takeButton(const InputEvent& event);
    void takeMove(glm::vec2 at);
    void pick(glm::vec2 at);
    void walk(float seconds);
    static bool isWalkingKey(int key);
    static bool movesInPanels(int key);
    void drawFrame();
    void describe(float seconds);
    void resizeIfNeeded();
    [[nodiscard]] bool isMoving() const;
    [[nodiscard]] glm::mat4 clip() const;
    void drawView(VkCommandBuffer commands, VkRenderPass pass, const VkRect2D& frame, bool linear);
    void drawWindow(VkCommandBuffer commands, bool withPanels);
    [[nodiscard]] relamp::Image lightOfView();
    [[nodiscard]] relamp::Image pictureOf(bool onlyView);

    std::unique_ptr<ScriptRunner> script_;
    bool keepsSettings_; // not those that a script had
    bool mustOpen_;      // what was named on the command line is not open yet
    std::set<int> heldKeys_;
    glm::vec2 pointer_{0.0f};
    enum class Drag { none, turn, pan, gizmo, slider };
    Drag drag_ = Drag::none;
    glm::vec2 pressedAt_{0.0f};
    bool hasMoved_ = false;
    std::chrono::steady_clock::time_point lastPress_{};
    int framesToDraw_ = 3;
    size_t framesDrawn_ = 0;
    bool isQuitting_ = false;
};
