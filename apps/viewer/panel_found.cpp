#include "panels.h"

#include "viewer.h"

#include <array>
#include <cmath>

#include <imgui.h>

namespace
{

/// Radiance over what the texture shows, in stops below white, both from -8 to 0.
void drawCurve(const relamp::Response& response, float width)
{
    constexpr float kStops = 8.0f;
    std::array<float, 65> curve{};
    for (size_t i = 0; i < curve.size(); ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(curve.size() - 1);
        curve[i] = std::log2(response(std::exp2(kStops * (share - 1.0f))));
    }
    ImGui::PlotLines("##response", curve.data(), static_cast<int>(curve.size()), 0, nullptr,
                     -kStops, 0.0f, {width, 0.5f * width});
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "Light over what the texture shows,\n8 stops up to white along each side");
}

void drawCamera(const relamp::CameraModel& camera)
{
    if (camera.isNeutral()) {
        ImGui::TextDisabled("The camera left light as it is.");
        return;
    }
    if (!camera.response.isStraight()) {
        ImGui::Text("Contrast %.2f", static_cast<double>(camera.response.contrast()));
        drawCurve(camera.response, ImGui::GetContentRegionAvail().x);
    }
    if (!camera.tone.gain.isOne())
        ImGui::Text("Tones mapped locally, power %.2f", static_cast<double>(camera.tone.exponent));
    if (!camera.gains.empty())
        ImGui::Text("%s over %.2f stops",
                    camera.hasDrifted() ? "Exposure drifts" : "What no lamp explains:",
                    static_cast<double>(camera.stops()));
}

void drawValidation(const relamp::CrossValidation& validation)
{
    if (validation.pairs == 0) {
        ImGui::TextDisabled("Too little of one paint to tell how even.");
        return;
    }
    ImGui::Text("One paint differs by %.2f stops", static_cast<double>(validation.scan));
    ImGui::Text("in the scan, by %.2f in the albedo:", static_cast<double>(validation.albedo));
    ImGui::Text("a gain of %.1f dB", static_cast<double>(validation.gain()));
    if (validation.shadingPower < 1.0f)
        ImGui::Text("Shading to the power of %.1f", static_cast<double>(validation.shadingPower));
}

} // namespace

void drawFoundPanel(Viewer& viewer)
{
    const Studio& studio = viewer.studio;
    if (studio.stage() < Stage::drafted) return ImGui::TextDisabled("Not solved yet.");
    drawCamera(studio.captured().camera);
    if (const auto validation = studio.crossValidation()) drawValidation(*validation);
}
