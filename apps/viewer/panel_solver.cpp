#include "panels.h"

#include "actions.h"
#include "viewer.h"

#include "relamp/error.h"

#include <algorithm>
#include <string>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace
{

void drawGather(relamp::GatherOptions& gather)
{
    int quality = static_cast<int>(gather.quality);
    if (ImGui::Combo("Quality", &quality, "Draft\0Standard\0High\0"))
        gather.quality = static_cast<relamp::Quality>(quality);
    ImGui::SliderInt("Rays", &gather.rays, 0, 1024, gather.rays == 0 ? "by quality" : "%d",
                     ImGuiSliderFlags_AlwaysClamp);
    if (gather.rays > 0) gather.rays = std::max(gather.rays, 4);
    ImGui::SliderInt("Shadow rays", &gather.shadowRays, 0, 1024,
                     gather.shadowRays == 0 ? "by quality" : "%d", ImGuiSliderFlags_AlwaysClamp);
    ImGui::Checkbox("Look for the sun", &gather.sun);
}

/// What a person said of places, and a way to take it all back.
void drawTold(SolverParameters& parameters)
{
    const relamp::GatherOptions& gather = parameters.gather;
    const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
    const bool isOfLamps = !gather.lights.empty() || !gather.notLights.empty();
    const bool isOfPaint = !gather.same.empty() || !gather.white.empty();
    if (isOfLamps)
        ImGui::TextDisabled("Lamps by hand: %d, none: %d", count(gather.lights),
                            count(gather.notLights));
    if (isOfPaint)
        ImGui::TextDisabled("Of one paint: %d pairs, white: %d", count(gather.same),
                            count(gather.white));
    if (!isOfLamps && !isOfPaint) return;
    ImGui::SameLine();
    if (ImGui::SmallButton("Forget")) parameters.forgetPlaces();
}

void drawPathtrace(relamp::PathtraceOptions& pathtrace)
{
    ImGui::SliderInt("Samples", &pathtrace.samples, 1, 65536, "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    const uint32_t step = 1;
    ImGui::InputScalar("Seed", ImGuiDataType_U32, &pathtrace.seed, &step);
}

/// A parameter that follows from the scan unless it is set.
void parameter(const char* label, std::optional<float>& value, float otherwise, float high)
{
    ImGui::PushID(label);
    bool isSet = value.has_value();
    if (ImGui::Checkbox("##set", &isSet)) value = isSet ? std::optional(otherwise) : std::nullopt;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight() -
                            ImGui::GetStyle().ItemSpacing.x);
    float shown = value.value_or(otherwise);
    if (!isSet) ImGui::BeginDisabled();
    if (ImGui::SliderFloat(label, &shown, 0.001f, high, isSet ? "%.3f" : "by the scan",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        value = shown;
    if (!isSet) ImGui::EndDisabled();
    ImGui::PopID();
}

void drawThesis(relamp::ThesisOptions& parameters)
{
    constexpr ImGuiSliderFlags kClamp = ImGuiSliderFlags_AlwaysClamp;
    parameter("Power", parameters.power, 1.0f, 100.0f);
    parameter("Ambient", parameters.ambient, 0.05f, 10.0f);
    parameter("Merge, m", parameters.mergeDistance, 0.5f, 10.0f);
    bool hasAttenuation = parameters.attenuation.has_value();
    if (ImGui::Checkbox("Attenuation by hand", &hasAttenuation))
        parameters.attenuation =
            hasAttenuation ? std::optional(glm::vec3(1.0f, 0.0f, 1.0f)) : std::nullopt;
    if (parameters.attenuation)
        ImGui::DragFloat3("k0 k1 k2", &parameters.attenuation->x, 0.01f, 0.0f, 1e4f, "%.3f",
                          kClamp);
    ImGui::SliderFloat("Shines from", &parameters.emitterThreshold, 0.0f, 1.0f, "%.2f", kClamp);
    ImGui::SliderFloat("Expansion", &parameters.expansion, 1.0f, 200.0f, "%.1f",
                       kClamp | ImGuiSliderFlags_Logarithmic);
    ImGui::SliderInt("Lights, 2^n", &parameters.lightLevels, 0, 10, "%d", kClamp);
    ImGui::SliderInt("Shadow map", &parameters.rsmSize, 8, 512, "%d", kClamp);
    ImGui::SliderInt("Volume", &parameters.lpvSize, 8, 128, "%d", kClamp);
    ImGui::SliderInt("Steps", &parameters.lpvSteps, 1, 128, "%d", kClamp);
    ImGui::SliderFloat("Flatten reach", &parameters.flattenReach, 1.0f, 2.0f, "%.2f", kClamp);
    ImGui::SliderFloat("Flatten range", &parameters.flattenRange, 0.01f, 10.0f, "%.2f",
                       kClamp | ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("Bounce light", &parameters.useLpv);
    ImGui::SameLine();
    ImGui::Checkbox("Ambient light", &parameters.useAmbient);
}

/// A place to save at, and a button.
bool pathField(const char* button, std::string& path)
{
    ImGui::PushID(button);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.66f);
    ImGui::InputText("##path", &path);
    ImGui::SameLine();
    const bool isAsked = ImGui::Button(button, {-1.0f, 0.0f}) && !path.empty();
    ImGui::PopID();
    return isAsked;
}

} // namespace

void drawSolverPanel(Viewer& viewer)
{
    SolverParameters& parameters = viewer.studio.edit.parameters;
    int solver = static_cast<int>(parameters.solver);
    if (ImGui::Combo("Solver", &solver, "Gather\0Path tracing, slow\0Thesis\0"))
        parameters.solver = static_cast<relamp::Solver>(solver);
    if (parameters.solver == relamp::Solver::thesis)
        drawThesis(parameters.thesis);
    else {
        drawGather(parameters.gather);
        drawTold(parameters);
    }
    if (parameters.solver == relamp::Solver::pathtrace) drawPathtrace(parameters.pathtrace);
    ImGui::SliderFloat("Darkest", &parameters.albedo.darkest, 0.001f, 1.0f, "%.3f",
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("Fill what is unlit", &parameters.albedo.fill);
    if (const auto& closure = viewer.studio.closure())
        ImGui::TextDisabled("Closed loop: %.4f of %.4f", closure->rmsError, closure->rmsInput);
}

void drawFilePanel(Viewer& viewer)
{
    Paths& paths = viewer.shown.paths;
    Studio& studio = viewer.studio;
    try {
        if (pathField("Open", paths.open)) studio.openAny(paths.open);
        if (pathField("Save light", paths.lights)) studio.saveLights(paths.lights);
        if (pathField("Save result", paths.result)) studio.saveResult(paths.result);
        if (pathField("Bake GLB", paths.baked)) studio.saveBaked(paths.baked);
        if (pathField("Page", paths.page)) studio.savePage(paths.page);
        if (pathField("Picture", paths.picture)) {
            viewer.screenshot(paths.picture, true);
            studio.say("The picture is " + paths.picture + ".");
        }
    } catch (const relamp::Error& error) {
        studio.say(error.what());
    }
    for (const std::string& recent : viewer.settings.recent)
        if (ImGui::Selectable(recent.c_str())) studio.openAny(recent);
}
