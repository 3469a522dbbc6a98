#include "panels.h"

#include "actions.h"
#include "viewer.h"

#include "relamp/names.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <glm/geometric.hpp>

namespace
{

using relamp::LightType;

void button(const char* label, const char* action, Viewer& viewer)
{
    if (ImGui::Button(label)) runAction(action, viewer);
}

/// A list of all lights; the box switches, the name selects.
void drawList(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    LightDocument& light = studio.edit.light;
    const size_t rows = light.fixtures.size() + light.lamps.size();
    if (rows == 0) return ImGui::TextDisabled("No lights yet");
    const float height = ImGui::GetTextLineHeightWithSpacing() *
                         static_cast<float>(std::clamp<size_t>(rows, 1, 7)) * 1.12f;
    ImGui::BeginChild("lights", {0.0f, height + 6.0f});
    const auto row = [&](Selection::Kind kind, size_t i, bool& on, const std::string& name) {
        ImGui::PushID(static_cast<int>(kind) * 100000 + static_cast<int>(i));
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0f, 1.0f});
        ImGui::Checkbox("##on", &on);
        ImGui::PopStyleVar();
        ImGui::SameLine();
        const Selection selection{kind, i};
        if (ImGui::Selectable(name.c_str(), studio.selection == selection))
            viewer.select(selection);
        ImGui::PopID();
    };
    for (size_t i = 0; i < std::min(light.fixtures.size(), studio.captured().fixtures.size()); ++i)
        row(Selection::Kind::fixture, i, light.fixtures[i].on,
            fmt::format("{}{}", studio.captured().nameOf(i),
                        light.fixtures[i].window ? ", window" : ""));
    for (size_t i = 0; i < light.lamps.size(); ++i) {
        const LampItem& lamp = light.lamps[i];
        row(Selection::Kind::lamp, i, light.lamps[i].on,
            lamp.name.empty() ? fmt::format("{} {}", relamp::nameOf(lamp.type), i) : lamp.name);
    }
    ImGui::EndChild();
}

/// Says a value instead of what the scan says, or leaves it.
void optionalSlider(const char* label, std::optional<float>& value, float otherwise, float low,
                    float high, const char* format)
{
    ImGui::PushID(label);
    bool isSet = value.has_value();
    if (ImGui::Checkbox("##set", &isSet)) value = isSet ? std::optional(otherwise) : std::nullopt;
    ImGui::SameLine();
    float shown = value.value_or(otherwise);
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight() -
                            ImGui::GetStyle().ItemSpacing.x);
    if (!isSet) ImGui::BeginDisabled();
    if (ImGui::SliderFloat(label, &shown, low, high, format,
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        value = shown;
    if (!isSet) ImGui::EndDisabled();
    ImGui::PopID();
}

void heading(const char* title)
{
    ImGui::Separator();
    ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s", title);
}

/// Power and colour of a fixture, in one of its two roles.
void drawPowerOf(FixtureItem& fixture)
{
    ImGui::SliderFloat("Power", &fixture.dim, 0.0f, 4.0f, "× %.2f", ImGuiSliderFlags_AlwaysClamp);
    optionalSlider("Lumens", fixture.lumens, 800.0f, 10.0f, 50000.0f, "%.0f lm");
    optionalSlider("Kelvin", fixture.kelvin, 2700.0f, 1500.0f, 12000.0f, "%.0f K");
}

/// Whether the albedo can follow what is said of the day of the scan; else says why not.
bool canTellOfScan(const Studio& studio)
{
    const bool isGather = studio.edit.parameters.solver == relamp::Solver::gather;
    const bool isSolved = studio.stage() == Stage::solved;
    if (!isGather) ImGui::TextDisabled("The solver Gather takes it into account.");
    if (isGather && !isSolved) ImGui::TextDisabled("It can be told once the room is solved.");
    return isGather && isSolved;
}

/// How a fixture was: what is said here changes the albedo.
void drawScanned(Viewer& viewer, size_t index)
{
    Studio& studio = viewer.studio;
    heading("On the day of the scan");
    if (!canTellOfScan(studio)) return;
    ImGui::PushID("scanned");
    FixtureItem& scanned = studio.edit.scanned.fixtures[index];
    ImGui::Checkbox("It was on (Shift+K)", &scanned.on);
    const bool isOff = !scanned.on;
    if (isOff) ImGui::BeginDisabled();
    drawPowerOf(scanned);
    if (isOff) ImGui::EndDisabled();
    ImGui::TextDisabled("The brighter it was, the darker the albedo.");
    ImGui::PopID();
}

void drawFixture(Viewer& viewer, size_t index)
{
    Studio& studio = viewer.studio;
    FixtureItem& fixture = studio.edit.light.fixtures[index];
    const relamp::Fixture& found = studio.captured().fixtures[index];
    ImGui::TextDisabled("%.2f m², at %.2f, %.2f, %.2f", found.area, found.centre.x, found.centre.y,
                        found.centre.z);
    if (!found.determined)
        ImGui::TextWrapped("The scan does not tell how bright it is; set it by hand.");
    drawScanned(viewer, index);
    button("It is no light (N)", "not-light", viewer);
    heading("Now, in the relit room");
    ImGui::Checkbox("It is on (K)", &fixture.on);
    drawPowerOf(fixture);
    ImGui::Checkbox("It is a window", &fixture.window);
}

/// How bright, and of what colour.
void drawEmission(LampItem& lamp)
{
    if (lamp.takesRgb()) {
        ImGui::DragFloat3(lamp.unit.c_str(), &lamp.rgb.x, 0.01f, 0.0f, 1e6f, "%.3f");
    } else if (lamp.unit != "ies") {
        const float most = lamp.unit == "lux" ? 100000.0f : 20000.0f;
        std::string label = lamp.unit;
        label[0] = static_cast<char>(std::toupper(label[0]));
        ImGui::SliderFloat(label.c_str(), &lamp.amount, 1.0f, most, "%.0f",
                           ImGuiSliderFlags_Logarithmic);
        lamp.amount = std::max(lamp.amount, 0.0f);
    }
    ImGui::SliderFloat("Power", &lamp.dim, 0.0f, 4.0f, "× %.2f", ImGuiSliderFlags_AlwaysClamp);
    if (lamp.takesRgb()) return;
    int colour = lamp.byKelvin ? 0 : 1;
    if (ImGui::Combo("Colour by", &colour, "Kelvin\0RGB\0")) lamp.byKelvin = colour == 0;
    if (lamp.byKelvin)
        ImGui::SliderFloat("Kelvin", &lamp.kelvin, 1500.0f, 12000.0f, "%.0f K",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    else
        ImGui::ColorEdit3("Colour", &lamp.colour.x,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
}

void drawShapeOf(LampItem& lamp)
{
    constexpr float kSmallest = 0.005f; // m
    if (lamp.type != LightType::sun)
        ImGui::DragFloat3("Place", &lamp.position.x, 0.01f, -1000.0f, 1000.0f, "%.2f");
    if (lamp.aims()) {
        glm::vec3 direction = lamp.direction;
        if (ImGui::DragFloat3("Direction", &direction.x, 0.01f, -1.0f, 1.0f, "%.2f") &&
            glm::length(direction) > 1e-3f)
            lamp.direction = glm::normalize(direction);
    }
    if (lamp.type == LightType::rectangle) {
        ImGui::DragFloat2("Size", &lamp.size.x, 0.01f, kSmallest, 20.0f, "%.2f m",
                          ImGuiSliderFlags_AlwaysClamp);
        lamp.size = glm::clamp(lamp.size, kSmallest, 20.0f);
    } else if (lamp.type != LightType::sun) {
        const bool isRound = lamp.type == LightType::disc || lamp.type == LightType::sphere;
        ImGui::DragFloat("Radius", &lamp.radius, 0.002f, isRound ? kSmallest : 0.0f, 5.0f, "%.3f m",
                         ImGuiSliderFlags_AlwaysClamp);
        lamp.radius = std::clamp(lamp.radius, isRound ? kSmallest : 0.0f, 5.0f);
    }
    if (lamp.type == LightType::spot) {
        ImGui::SliderFloat("Cone", &lamp.cone, 2.0f, 170.0f, "%.0f°", ImGuiSliderFlags_AlwaysClamp);
        ImGui::SliderFloat("Soft edge", &lamp.blend, 0.0f, 1.0f, "%.2f",
                           ImGuiSliderFlags_AlwaysClamp);
    }
}

void drawLamp(Viewer& viewer, size_t index)
{
    LampItem& lamp = viewer.studio.edit.light.lamps[index];
    ImGui::InputTextWithHint("Name", relamp::nameOf(lamp.type), &lamp.name);
    drawEmission(lamp);
    drawShapeOf(lamp);
    button("Copy", "copy", viewer);
    ImGui::SameLine();
    button("Remove", "remove", viewer);
}

void drawPlace(Viewer& viewer)
{
    if (!viewer.studio.place || viewer.studio.selection.kind != Selection::Kind::none) return;
    ImGui::TextDisabled("Place %.2f, %.2f, %.2f", viewer.studio.place->x, viewer.studio.place->y,
                        viewer.studio.place->z);
    button("This is a light (L)", "is-light", viewer);
    button(viewer.studio.paint ? "And this is of that paint (O)" : "Of one paint with ... (O)",
           "one-paint", viewer);
    button("This is white (I)", "is-white", viewer);
}

/// Lights that rooms often have, to begin with.
void drawPresets(Viewer& viewer)
{
    if (!ImGui::BeginCombo("Presets", "Choose")) return;
    Studio& studio = viewer.studio;
    LightDocument& light = studio.edit.light;
    const auto all = [&](bool on, std::optional<float> kelvin, float dim) {
        for (FixtureItem& fixture : light.fixtures) {
            fixture.on = on;
            fixture.kelvin = kelvin;
            fixture.dim = dim;
        }
    };
    if (ImGui::Selectable("As scanned")) light = documentOf(studio.captured());
    if (ImGui::Selectable("Warm evening: dimmed, 2300 K")) all(true, 2300.0f, 0.35f);
    if (ImGui::Selectable("Office: 4000 K")) all(true, 4000.0f, 1.0f);
    if (ImGui::Selectable("Night: all off, moonlight")) {
        all(false, std::nullopt, 1.0f);
        light.lamps.clear();
        light.sky.radiance = glm::vec3(0.004f, 0.006f, 0.010f);
    }
    ImGui::EndCombo();
}

/// Brightness and colour of what shines all around; whether they are new.
bool radianceSlider(const char* label, glm::vec3& radiance)
{
    ImGui::PushID(label);
    float brightness = std::max(radiance.r, std::max(radiance.g, radiance.b));
    glm::vec3 colour = brightness > 0.0f ? radiance / brightness : glm::vec3(1.0f);
    bool isNew = ImGui::SliderFloat(label, &brightness, 0.0f, 50.0f, "%.3f",
                                    ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    isNew |= ImGui::ColorEdit3("Its colour", &colour.x,
                               ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
    if (isNew) radiance = brightness * glm::max(colour, 0.0f);
    ImGui::PopID();
    return isNew;
}

/// Plays a day.
void drawTimeline(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    if (!studio.hasTimeline()) return ImGui::TextDisabled("Drop a timeline to play it (Space)");
    button(studio.isPlaying() ? "Stop" : "Play", "play", viewer);
    ImGui::SameLine();
    auto part = static_cast<float>(studio.timelinePart());
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderFloat("##time", &part, 0.0f, 1.0f, "time %.2f", ImGuiSliderFlags_AlwaysClamp))
        studio.seek(part);
}

/// Sun and sky as they were: what is said here changes the albedo.
void drawScannedSky(Studio& studio)
{
    heading("On the day of the scan");
    if (!canTellOfScan(studio)) return;
    ScannedItems& scanned = studio.edit.scanned;
    ImGui::PushID("scanned");
    if (studio.found().sun) {
        ImGui::SliderFloat("Sun", &scanned.sun, 0.0f, 4.0f, "× %.2f", ImGuiSliderFlags_AlwaysClamp);
        ImGui::ColorEdit3("Times colour", &scanned.sunColour.x,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
        scanned.sunColour = glm::max(scanned.sunColour, 0.0f);
    }
    glm::vec3 ambient = scanned.ambient.value_or(studio.found().ambient);
    if (radianceSlider("Around", ambient)) scanned.ambient = ambient;
    ImGui::TextDisabled("What lies around shines in where the scan has holes.");
    ImGui::PopID();
}

/// Lights of one's own.
void drawAdding(Viewer& viewer)
{
    button("Point", "add-point", viewer);
    ImGui::SameLine();
    button("Spot", "add-spot", viewer);
    ImGui::SameLine();
    button("Panel", "add-rectangle", viewer);
    ImGui::SameLine();
    button("Disc", "add-disc", viewer);
    ImGui::SameLine();
    button("Globe", "add-sphere", viewer);
}

} // namespace

void drawLightPanel(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    drawAdding(viewer); // above the list, so that it stays where it is whatever is found
    drawList(viewer);
    drawPlace(viewer);
    const size_t i = studio.selection.index;
    ImGui::Separator();
    if (studio.selection.kind == Selection::Kind::fixture &&
        i < studio.edit.light.fixtures.size() && i < studio.captured().fixtures.size())
        drawFixture(viewer, i);
    if (studio.selection.kind == Selection::Kind::lamp && i < studio.edit.light.lamps.size())
        drawLamp(viewer, i);
    button("All on", "all-on", viewer);
    ImGui::SameLine();
    button("All off", "all-off", viewer);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
    drawPresets(viewer);
}

void drawSkyPanel(Viewer& viewer)
{
    Studio& studio = viewer.studio;
    SkyItem& sky = studio.edit.light.sky;
    glm::vec3 radiance = sky.radiance.value_or(sky.nits / 100.0f * sky.colour);
    if (radianceSlider("Sky", radiance)) sky.radiance = radiance;
    if (!sky.environment.empty()) {
        ImGui::SliderFloat("Turn", &sky.turn, 0.0f, 360.0f, "%.0f°", ImGuiSliderFlags_AlwaysClamp);
        ImGui::TextDisabled("%s", sky.environment.c_str());
    }
    button("Put up a sun", "add-sun", viewer);
    drawTimeline(viewer);
    drawScannedSky(studio);
}
