#include "overlay.h"

#include "viewer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <imgui.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace
{

constexpr ImU32 kInk = IM_COL32(20, 20, 22, 220);
constexpr ImU32 kAccent = IM_COL32(242, 173, 64, 255);
constexpr ImU32 kOff = IM_COL32(150, 152, 158, 255);
constexpr ImU32 kWhite = IM_COL32(240, 240, 240, 255);
constexpr float kReach = 14.0f; // pixels around a mark

/// Draws in the view's part of the window.
class Pen
{
public:
    explicit Pen(const Viewer& viewer)
        : viewer_(viewer), list_(ImGui::GetBackgroundDrawList()), frame_(viewer.frame()),
          scale_(viewer.scale())
    {
        const ImVec2 low(static_cast<float>(frame_.offset.x), static_cast<float>(frame_.offset.y));
        list_->PushClipRect(low, {low.x + static_cast<float>(frame_.extent.width),
                                  low.y + static_cast<float>(frame_.extent.height)});
    }
    ~Pen() { list_->PopClipRect(); }
    Pen(const Pen&) = delete;
    Pen& operator=(const Pen&) = delete;

    /// Nothing where the point is behind the camera.
    [[nodiscard]] std::optional<ImVec2> at(glm::vec3 point) const
    {
        const glm::vec3 screen = viewer_.studio.camera.onScreen(point, viewer_.aspect());
        if (screen.z <= 0.02f) return std::nullopt;
        return ImVec2(static_cast<float>(frame_.offset.x) +
                          screen.x * static_cast<float>(frame_.extent.width),
                      static_cast<float>(frame_.offset.y) +
                          screen.y * static_cast<float>(frame_.extent.height));
    }

    void line(glm::vec3 a, glm::vec3 b, ImU32 colour, float width) const
    {
        const auto from = at(a);
        const auto to = at(b);
        if (!from || !to) return;
        list_->AddLine(*from, *to, kInk, (width + 2.0f) * scale_);
        list_->AddLine(*from, *to, colour, width * scale_);
    }

    void dot(glm::vec3 point, ImU32 colour, float radius) const
    {
        const auto centre = at(point);
        if (!centre) return;
        list_->AddCircleFilled(*centre, (radius + 1.5f) * scale_, kInk);
        list_->AddCircleFilled(*centre, radius * scale_, colour);
    }

    void ring(glm::vec3 point, ImU32 colour, float radius) const
    {
        const auto centre = at(point);
        if (!centre) return;
        list_->AddCircle(*centre, radius * scale_, kInk, 0, 4.0f * scale_);
        list_->AddCircle(*centre, radius * scale_, colour, 0, 2.0f * scale_);
    }

    void text(glm::vec3 point, const std::string& words) const
    {
        const auto centre = at(point);
        if (!centre) return;
        const ImVec2 place(centre->x + 12.0f * scale_, centre->y - 8.0f * scale_);
        list_->AddText({place.x + 1.0f, place.y + 1.0f}, kInk, words.c_str());
        list_->AddText(place, kWhite, words.c_str());
    }

    /// A circle in space.
    void circle(glm::vec3 centre, glm::vec3 normal, float radius, ImU32 colour) const
    {
        constexpr int kParts = 32;
        const glm::vec3 other = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 u = glm::normalize(glm::cross(normal, other));
        const glm::vec3 v = glm::cross(normal, u);
        const auto on = [&](int i) {
            const float angle = 6.2831853f * static_cast<float>(i) / kParts;
            return centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
        };
        for (int i = 0; i < kParts; ++i) line(on(i), on(i + 1), colour, 1.5f);
    }

private:
    const Viewer& viewer_;
    ImDrawList* list_;
    VkRect2D frame_;
    float scale_;
};

/// How a light that is put up spreads: a spot's cone, a panel's outline.
void drawShape(const Pen& pen, const LampItem& lamp)
{
    using relamp::LightType;
    if (lamp.type == LightType::spot) {
        const float half = glm::radians(std::min(0.5f * lamp.cone, 80.0f));
        const float length = 0.6f;
        const glm::vec3 rim = lamp.position + length * lamp.direction;
        const float radius = length * std::tan(half);
        pen.circle(rim, lamp.direction, radius, kAccent);
        const glm::vec3 other =
            std::abs(lamp.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 u = glm::normalize(glm::cross(lamp.direction, other));
        const glm::vec3 v = glm::cross(lamp.direction, u);
        for (const glm::vec3& side : {u, -u, v, -v})
            pen.line(lamp.position, rim + radius * side, kAccent, 1.0f);
    }
    if (lamp.type == LightType::disc || lamp.type == LightType::sphere)
        pen.circle(lamp.position, lamp.direction, lamp.radius, kAccent);
}

void drawGizmo(const Pen& pen, const Viewer& viewer, const Aimed& light)
{
    const Gizmo::Eye eye = viewer.eye();
    const struct
    {
        Handle handle;
        ImU32 colour;
    } axes[] = {{Handle::x, IM_COL32(236, 92, 86, 255)},
                {Handle::y, IM_COL32(122, 204, 92, 255)},
                {Handle::z, IM_COL32(92, 148, 244, 255)}};
    for (const auto& axis : axes) {
        const glm::vec3 tip = Gizmo::tipOf(axis.handle, light, eye);
        pen.line(light.position, tip, axis.colour, 2.5f);
        pen.dot(tip, axis.colour, 5.0f);
    }
    if (light.aims) {
        const glm::vec3 tip = Gizmo::tipOf(Handle::aim, light, eye);
        pen.line(light.position, tip, kAccent, 2.0f);
        pen.ring(tip, kAccent, 6.0f);
    }
    pen.dot(light.position, kWhite, 5.0f);
}

void drawSlider(const Viewer& viewer)
{
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const VkRect2D frame = viewer.frame();
    const auto left = static_cast<float>(frame.offset.x);
    const auto top = static_cast<float>(frame.offset.y);
    const auto height = static_cast<float>(frame.extent.height);
    const float x = left + viewer.shown.slider * static_cast<float>(frame.extent.width);
    const float scale = viewer.scale();
    list->AddLine({x, top}, {x, top + height}, kInk, 4.0f * scale);
    list->AddLine({x, top}, {x, top + height}, kWhite, 2.0f * scale);
    const float middle = top + 0.5f * height;
    list->AddCircleFilled({x, middle}, 13.0f * scale, kInk);
    list->AddCircleFilled({x, middle}, 11.0f * scale, kWhite);
    const float s = 4.0f * scale;
    list->AddTriangleFilled({x - 2 * s, middle}, {x - 0.6f * s, middle - s},
                            {x - 0.6f * s, middle + s}, kInk);
    list->AddTriangleFilled({x + 2 * s, middle}, {x + 0.6f * s, middle + s},
                            {x + 0.6f * s, middle - s}, kInk);
    const auto titleOf = [](Layer layer) { return kLayers[static_cast<size_t>(layer)].title; };
    const auto label = [&](const char* words, float at) {
        list->AddText({at + 1.0f, top + 11.0f * scale}, kInk, words);
        list->AddText({at, top + 10.0f * scale}, kWhite, words);
    };
    const char* before = titleOf(viewer.available(viewer.shown.before));
    label(before, x - ImGui::CalcTextSize(before).x - 10.0f * scale);
    label(titleOf(viewer.available(viewer.shown.layer)), x + 10.0f * scale);
}

void drawLights(const Pen& pen, const Viewer& viewer)
{
    const Studio& studio = viewer.studio;
    const auto isChosen = [&](Selection::Kind kind, size_t i) {
        return studio.selection == Selection{kind, i};
    };
    for (size_t i = 0;
         i < std::min(studio.captured().fixtures.size(), studio.edit.light.fixtures.size()); ++i) {
        const bool isOn = studio.edit.light.fixtures[i].on;
        const bool isThis = isChosen(Selection::Kind::fixture, i);
        const glm::vec3 centre = studio.captured().fixtures[i].centre;
        pen.ring(centre, isOn ? kAccent : kOff, isThis ? 10.0f : 7.0f);
        if (isThis) pen.dot(centre, kWhite, 3.0f);
        if (isThis) pen.text(centre, studio.captured().nameOf(i));
    }
    for (size_t i = 0; i < studio.edit.light.lamps.size(); ++i) {
        const LampItem& lamp = studio.edit.light.lamps[i];
        if (lamp.type == relamp::LightType::sun) continue;
        pen.dot(lamp.position, lamp.on ? kAccent : kOff,
                isChosen(Selection::Kind::lamp, i) ? 7.0f : 5.0f);
        if (isChosen(Selection::Kind::lamp, i)) drawShape(pen, lamp);
    }
}

/// What was said of paint: pairs with a line between, white as dots.
void drawPaint(const Pen& pen, const Viewer& viewer)
{
    const relamp::GatherOptions& gather = viewer.studio.edit.parameters.gather;
    for (const auto& [a, b] : gather.same) {
        pen.line(a, b, kOff, 1.0f);
        pen.dot(a, kOff, 3.0f);
        pen.dot(b, kOff, 3.0f);
    }
    for (const glm::vec3 place : gather.white) pen.dot(place, kWhite, 3.0f);
    if (!viewer.studio.paint) return;
    pen.dot(*viewer.studio.paint, kOff, 4.0f);
    if (viewer.studio.place) pen.line(*viewer.studio.paint, *viewer.studio.place, kOff, 1.0f);
}

} // namespace

void drawOverlay(const Viewer& viewer)
{
    if (viewer.studio.scan() == nullptr) return;
    if (viewer.shown.compares) drawSlider(viewer);
    if (!viewer.shown.marks || viewer.shown.atlas) return;
    const Pen pen(viewer);
    drawLights(pen, viewer);
    drawPaint(pen, viewer);
    if (viewer.studio.place) pen.ring(*viewer.studio.place, kWhite, 4.0f);
    if (const auto light = viewer.selectedLight()) drawGizmo(pen, viewer, *light);
}

Selection lightUnder(const Viewer& viewer, glm::vec2 pixel)
{
    if (!viewer.shown.marks) return {};
    const Studio& studio = viewer.studio;
    const glm::vec2 size = viewer.eye().pixels;
    Selection best;
    float nearest = kReach * viewer.scale();
    const auto consider = [&](glm::vec3 place, Selection candidate) {
        const glm::vec3 screen = studio.camera.onScreen(place, viewer.aspect());
        const float away = glm::length(glm::vec2(screen) * size - pixel);
        if (screen.z <= 0.02f || away >= nearest) return;
        nearest = away;
        best = candidate;
    };
    for (size_t i = 0; i < studio.captured().fixtures.size(); ++i)
        consider(studio.captured().fixtures[i].centre, {Selection::Kind::fixture, i});
    for (size_t i = 0; i < studio.edit.light.lamps.size(); ++i)
        if (studio.edit.light.lamps[i].type != relamp::LightType::sun)
            consider(studio.edit.light.lamps[i].position, {Selection::Kind::lamp, i});
    return best;
}

Selection fixtureAt(const Viewer& viewer, glm::vec3 place)
{
    const std::vector<relamp::Fixture>& fixtures = viewer.studio.captured().fixtures;
    Selection best;
    float nearest = 1.0f; // of a fixture's own reach
    for (size_t i = 0; i < fixtures.size(); ++i) {
        const float reach = std::max(0.8f * std::sqrt(fixtures[i].area), 0.05f);
        const float away = glm::distance(fixtures[i].centre, place) / reach;
        if (away >= nearest) continue;
        nearest = away;
        best = {Selection::Kind::fixture, i};
    }
    return best;
}
