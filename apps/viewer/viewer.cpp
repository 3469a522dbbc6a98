#include "viewer.h"

#include "actions.h"
#include "overlay.h"
#include "panels.h"
#include "script_runner.h"

#include "relamp/error.h"
#include "relamp/names.h"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace
{

using Clock = std::chrono::steady_clock;

constexpr float kPanelWidth = 340.0f; // at scale 1
constexpr float kStatusHeight = 30.0f;
constexpr float kClick = 4.0f;        // pixels; a longer way is a drag
constexpr float kDoubleClick = 0.35f; // s
constexpr float kTurn = 0.005f;       // rad a pixel
constexpr float kPace = 1.4f;         // m/s on foot
constexpr int kFramesAfterEvent = 3;  // that ImGui needs to settle
constexpr double kIdle = 0.05;        // s to sleep where nothing happens
constexpr float kProgress = 0.25f;    // s between frames that show no more than progress

glm::ivec2 sizeOf(const Viewer::Options& options, const Settings& settings)
{
    return options.size ? *options.size : glm::ivec2(settings.width, settings.height);
}

} // namespace

Viewer::Viewer(const Options& options)
    // A script finds the viewer as it is by itself, whatever somebody did before.
    : settings(options.script.empty() ? readSettings(settingsFile()) : Settings{}),
      window_(sizeOf(options, settings), "relamp"),
      device_(window_.get(), {options.engine.gpu, options.smooth}),
      target_(device_, VK_FORMAT_R8G8B8A8_UNORM, static_cast<uint32_t>(window_.pixels().x),
              static_cast<uint32_t>(window_.pixels().y)),
      swapchain_(device_, target_.size(), options.script.empty()),
      panels_(device_, window_, target_.pass()), drawing_(device_), scale_(window_.scale()),
      studio(drawing_, options.engine, [] { Window::wake(); }),
      keepsSettings_(options.script.empty()), mustOpen_(!options.path.empty())
{
    shown.panels = settings.panels;
    if (settings.walks) studio.camera.mode = CameraRig::Mode::walk;
    studio.edit.view.view =
        relamp::named<relamp::View>(settings.view).value_or(relamp::View::standard);
    if (const auto quality = relamp::named<relamp::Quality>(settings.quality))
        studio.edit.parameters.gather.quality = *quality;
    if (!options.path.empty()) studio.open(options.path, options.scan);
    if (!options.script.empty())
        script_ = std::make_unique<ScriptRunner>(readScript(options.script), options.script);
}

Viewer::~Viewer()
{
    if (!keepsSettings_) return;
    const glm::vec2 size = glm::vec2(window_.pixels()) / window_.pixelsPerUnit();
    if (size.x > 0.0f) {
        settings.width = static_cast<int>(size.x);
        settings.height = static_cast<int>(size.y);
    }
    settings.panels = shown.panels;
    settings.walks = studio.camera.mode == CameraRig::Mode::walk;
    settings.view = relamp::nameOf(studio.edit.view.view);
    settings.quality = relamp::nameOf(studio.edit.parameters.gather.quality);
    if (!studio.path().empty()) {
        const std::string path = std::filesystem::absolute(studio.path()).string();
        std::erase(settings.recent, path);
        settings.recent.insert(settings.recent.begin(), path);
    }
    writeSettings(settingsFile(), settings);
}

bool Viewer::isMoving() const
{
    return framesToDraw_ > 0 || (script_ && script_->needsFrames()) || studio.isPlaying() ||
           drag_ != Drag::none || !heldKeys_.empty();
}

void Viewer::run()
{
    auto last = Clock::now(); // that a frame was drawn
    while (!isQuitting_ && !window_.isClosed()) {
        // What sleeps is woken by an event, or by a thread that has found something.
        const std::vector<InputEvent> events = window_.events(isMoving() ? 0.0 : kIdle);
        if (!script_) takeAll(events);
        if (studio.deliver()) framesToDraw_ = kFramesAfterEvent;
        failIfNotOpened();
        if (script_) stepScript();
        const auto now = Clock::now();
        const float seconds = std::chrono::duration<float>(now - last).count();
        if (isQuitting_ || (!isMoving() && seconds < kProgress)) continue;
        last = now;
        studio.passTime(seconds);
        walk(std::min(seconds, 0.1f));
        resizeIfNeeded();
        describe(seconds);
        drawFrame();
        framesToDraw_ = std::max(framesToDraw_ - 1, 0);
    }
    device_.gpu().wait();
}

/// What is named on the command line and cannot be read ends the program, as it does any other.
void Viewer::failIfNotOpened()
{
    mustOpen_ = mustOpen_ && studio.scan() == nullptr && studio.openings() == 1;
    if (mustOpen_ && studio.hasFailed())
        throw relamp::Error(relamp::ErrorCode::cannotRead, studio.messages.back());
}

/// A script that has ended ends the viewer when all is saved, or hands it over.
void Viewer::stepScript()
{
    if (script_->step(*this, [this](const InputEvent& event) { take(event); })) return;
    if (script_->stays())
        script_ = nullptr;
    else if (!studio.isSaving())
        quit();
}

void Viewer::resizeIfNeeded()
{
    const glm::ivec2 pixels = window_.pixels();
    const VkExtent2D size{static_cast<uint32_t>(pixels.x), static_cast<uint32_t>(pixels.y)};
    if (size.width == 0 || size.height == 0) return;
    if (size.width == target_.size().width && size.height == target_.size().height) return;
    device_.gpu().wait();
    target_.resize(size.width, size.height);
    swapchain_.resize(size);
}

void Viewer::describe(float seconds)
{
    const VkExtent2D size = target_.size();
    PanelDrawing::begin({static_cast<int>(size.width), static_cast<int>(size.height)}, seconds);
    drawOverlay(*this);
    drawPanels(*this);
    window_.setPointer(ImGui::GetMouseCursor());
    PanelDrawing::end();
}

VkRect2D Viewer::frame() const
{
    const VkExtent2D size = target_.size();
    if (!shown.panels) return {{0, 0}, size};
    const uint32_t left = std::min(static_cast<uint32_t>(kPanelWidth * scale_), size.width / 2);
    const uint32_t bottom =
        std::min(static_cast<uint32_t>(kStatusHeight * scale_), size.height / 4);
    return {{static_cast<int32_t>(left), 0}, {size.width - left, size.height - bottom}};
}

float Viewer::aspect() const
{
    const VkExtent2D size = frame().extent;
    return static_cast<float>(std::max(size.width, 1u)) /
           static_cast<float>(std::max(size.height, 1u));
}

Gizmo::Eye Viewer::eye() const
{
    const VkExtent2D size = frame().extent;
    return {studio.camera,
            {static_cast<float>(std::max(size.width, 1u)),
             static_cast<float>(std::max(size.height, 1u))}};
}

glm::vec2 Viewer::inFrame(glm::vec2 pixel) const
{
    const VkOffset2D offset = frame().offset;
    return pixel - glm::vec2(offset.x, offset.y);
}

Layer Viewer::available(Layer layer) const
{
    return drawing_.has(layer) ? layer : Layer::scan;
}

void Viewer::select(const Selection& selection)
{
    studio.settle();
    studio.selection = selection;
}

std::optional<Aimed> Viewer::selectedLight() const
{
    const size_t i = studio.selection.index;
    if (studio.selection.kind != Selection::Kind::lamp || i >= studio.edit.light.lamps.size() ||
        studio.edit.light.lamps[i].type == relamp::LightType::sun)
        return std::nullopt;
    const LampItem& lamp = studio.edit.light.lamps[i];
    return Aimed{lamp.position, lamp.direction, lamp.aims()};
}

void Viewer::setSelectedLight(const Aimed& light, const std::string& step)
{
    LampItem& lamp = studio.edit.light.lamps[studio.selection.index];
    lamp.position = light.position;
    lamp.direction = light.direction;
    studio.commit(step);
}

/// ImGui sees each event in a pass of its own: a click whose press and release came between two
/// frames is none for it, and only a pass after the move tells whether a panel is under the mouse.
void Viewer::takeAll(const std::vector<InputEvent>& events)
{
    for (size_t i = 0; i < events.size(); ++i) {
        const auto isMove = [&](size_t at) {
            return at < events.size() && events[at].kind == InputEvent::Kind::move;
        };
        take(events[i]);
        if (i + 1 < events.size() && !(isMove(i) && isMove(i + 1))) describe(0.0f);
    }
}

void Viewer::take(const InputEvent& event)
{
    framesToDraw_ = kFramesAfterEvent;
    // ImGui would begin to type into the first field.
    const bool isTab = event.kind == InputEvent::Kind::key && event.code == GLFW_KEY_TAB;
    if (!isTab || shown.inPanels || !event.down) PanelDrawing::take(event);
    switch (event.kind) {
    case InputEvent::Kind::key:
        return takeKey(event);
    case InputEvent::Kind::button:
        return takeButton(event);
    case InputEvent::Kind::move:
        return takeMove(event.at);
    case InputEvent::Kind::scroll:
        if (ImGui::GetIO().WantCaptureMouse) return;
        if (shown.atlas) {
            shown.atlasZoom =
                std::clamp(shown.atlasZoom * std::pow(1.15f, event.at.y), 0.1f, 200.0f);
        } else {
            studio.isCameraUntouched = false;
            studio.camera.approach(event.at.y);
        }
        return;
    case InputEvent::Kind::drop:
        studio.openAny(event.text);
        if (std::filesystem::path(event.text).extension() == ".json") shown.layer = Layer::relit;
        return;
    case InputEvent::Kind::text:
        return;
    }
}

void Viewer::takeButton(const InputEvent& event)
{
    if (!event.down) {
        if (drag_ == Drag::turn && !hasMoved_ && event.code == GLFW_MOUSE_BUTTON_LEFT)
            pick(inFrame(pressedAt_));
        if (drag_ == Drag::gizmo) studio.settle();
        gizmo.release();
        drag_ = Drag::none;
        return;
    }
    if (ImGui::GetIO().WantCaptureMouse || drag_ != Drag::none) return;
    pressedAt_ = pointer_;
    hasMoved_ = false;
    drag_ = event.code == GLFW_MOUSE_BUTTON_LEFT && (event.mods & GLFW_MOD_SHIFT) == 0 ? Drag::turn
                                                                                       : Drag::pan;
    if (drag_ != Drag::turn) return;
    const glm::vec2 at = inFrame(pointer_);
    const float slider = shown.slider * eye().pixels.x;
    if (shown.compares && std::abs(at.x - slider) < 12.0f * scale_) {
        drag_ = Drag::slider;
        return;
    }
    const auto light = shown.marks && !shown.atlas ? selectedLight() : std::nullopt;
    const Handle handle = light ? Gizmo::under(at, *light, eye()) : Handle::none;
    if (handle == Handle::none) return;
    gizmo.grab(handle, at, *light, eye());
    drag_ = Drag::gizmo;
}

void Viewer::takeMove(glm::vec2 at)
{
    const glm::vec2 by = at - pointer_;
    pointer_ = at;
    hasMoved_ = hasMoved_ || glm::length(at - pressedAt_) > kClick * scale_;
    if (drag_ == Drag::none || !hasMoved_) return;
    const glm::vec2 size = eye().pixels;
    if (drag_ == Drag::slider) {
        shown.slider = std::clamp(inFrame(at).x / size.x, 0.0f, 1.0f);
    } else if (drag_ == Drag::gizmo) {
        const Aimed light = gizmo.dragged(inFrame(at), eye());
        if (selectedLight())
            setSelectedLight(light, gizmo.held() == Handle::aim ? "Turn light" : "Move light");
    } else if (shown.atlas) {
        shown.atlasCentre -= by / (size.y * shown.atlasZoom);
    } else if (drag_ == Drag::turn) {
        studio.isCameraUntouched = false;
        const float sign = studio.camera.mode == CameraRig::Mode::orbit ? 1.0f : -1.0f;
        studio.camera.turn(sign * kTurn / scale_ * glm::vec2(by.x, -by.y));
    } else {
        studio.isCameraUntouched = false;
        studio.camera.pan(glm::vec2(-by.x, by.y) / size.y);
    }
}

void Viewer::pick(glm::vec2 at)
{
    const auto now = Clock::now();
    const bool isDouble = std::chrono::duration<float>(now - lastPress_).count() < kDoubleClick;
    lastPress_ = now;
    if (shown.atlas || studio.scan() == nullptr) return;
    if (const Selection mark = lightUnder(*this, at); mark.kind != Selection::Kind::none)
        return select(mark);
    const VkRect2D view = frame();
    const glm::vec2 pixel = at + glm::vec2(view.offset.x, view.offset.y);
    const float depth =
        target_.depthAt(static_cast<uint32_t>(pixel.x), static_cast<uint32_t>(pixel.y));
    studio.place.reset();
    if (depth >= 1.0f) return select({});
    studio.place = studio.camera.pointAt(at / eye().pixels, depth, aspect());
    select(fixtureAt(*this, *studio.place));
    if (isDouble) studio.camera.lookAt(*studio.place);
}

void Viewer::takeKey(const InputEvent& event)
{
    event.down ? void(heldKeys_.insert(event.code)) : void(heldKeys_.erase(event.code));
    const bool isModifier = event.code >= GLFW_KEY_LEFT_SHIFT && event.code <= GLFW_KEY_MENU;
    if (!event.down || isModifier || ImGui::GetIO().WantTextInput) return;
    constexpr int kMods = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT;
    const int mods = event.mods & kMods;
    if (mods == 0 && isWalkingKey(event.code) && studio.camera.mode == CameraRig::Mode::walk)
        return;
    if (shown.inPanels && mods == 0 && movesInPanels(event.code)) return;
    // Plus is an equals sign with shift on many keyboards.
    const bool isPlus = event.code == GLFW_KEY_EQUAL;
    runActionOf({event.code, isPlus ? mods & ~GLFW_MOD_SHIFT : mods}, *this);
}

bool Viewer::movesInPanels(int key)
{
    return key == GLFW_KEY_TAB || key == GLFW_KEY_SPACE || key == GLFW_KEY_DELETE;
}

bool Viewer::isWalkingKey(int key)
{
    return key == GLFW_KEY_W || key == GLFW_KEY_A || key == GLFW_KEY_S || key == GLFW_KEY_D ||
           key == GLFW_KEY_Q || key == GLFW_KEY_E;
}

/// Keys that are held: the camera, or the light that is selected.
void Viewer::walk(float seconds)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || shown.inPanels || io.KeyCtrl) return;
    const auto axis = [&](int positive, int negative) {
        return (isHeld(positive) ? 1.0f : 0.0f) - (isHeld(negative) ? 1.0f : 0.0f);
    };
    const glm::vec3 arrows(axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT),
                           axis(GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN),
                           axis(GLFW_KEY_UP, GLFW_KEY_DOWN));
    CameraRig& camera = studio.camera;
    if (camera.mode == CameraRig::Mode::walk) {
        const glm::vec3 steps(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                              axis(GLFW_KEY_W, GLFW_KEY_S));
        if (steps != glm::vec3(0.0f)) {
            studio.isCameraUntouched = false;
            camera.walk(kPace * (io.KeyShift ? 3.0f : 1.0f) * seconds * steps);
        }
    }
    if (arrows == glm::vec3(0.0f)) return;
    if (auto light = selectedLight()) {
        if (io.KeyShift) {
            light->direction =
                glm::normalize(light->direction +
                               seconds * (arrows.x * camera.right() + arrows.y * camera.forward() +
                                          arrows.z * glm::vec3(0, 1, 0)));
            return setSelectedLight(*light, "Turn light");
        }
        const glm::vec3 ahead = glm::cross(glm::vec3(0, 1, 0), camera.right());
        light->position +=
            0.6f * seconds *
            (arrows.x * camera.right() + arrows.y * glm::vec3(0, 1, 0) + arrows.z * ahead);
        return setSelectedLight(*light, "Move light");
    }
    studio.isCameraUntouched = false;
    camera.turn(1.2f * seconds * glm::vec2(arrows.x, arrows.z));
    if (arrows.y != 0.0f) camera.approach(6.0f * seconds * arrows.y);
}

glm::mat4 Viewer::clip() const
{
    if (!shown.atlas) return studio.camera.clipFromWorld(aspect());
    // Of the atlas: v points down, as Vulkan's y does.
    glm::mat4 clip(1.0f);
    clip = glm::scale(clip, {1.8f * shown.atlasZoom / aspect(), 1.8f * shown.atlasZoom, 1.0f});
    return glm::translate(clip, {-shown.atlasCentre, 0.5f});
}
