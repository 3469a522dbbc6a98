#include "panels.h"

#include "actions.h"
#include "viewer.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

namespace
{

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void drawLayers(Viewer& viewer)
{
    for (size_t i = 0; i < kLayers.size(); ++i) {
        const Layer layer = kLayers[i].layer;
        const bool isThere = viewer.has(layer);
        if (!isThere)
            ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        const std::string label = fmt::format("{}   {}", i + 1, kLayers[i].title);
        if (ImGui::Selectable(label.c_str(), viewer.shown.layer == layer))
            viewer.shown.layer = layer;
        if (!isThere) ImGui::PopStyleColor();
    }
}

void drawBefore(Viewer& viewer)
{
    Shown& shown = viewer.shown;
    ImGui::Checkbox("Before / after", &shown.compares);
    if (!shown.compares) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##before", kLayers[static_cast<size_t>(shown.before)].title)) {
        for (const LayerName& layer : kLayers)
            if (ImGui::Selectable(layer.title, shown.before == layer.layer))
                shown.before = layer.layer;
        ImGui::EndCombo();
    }
}

void drawView(Viewer& viewer)
{
    relamp::ViewOptions& view = viewer.studio.edit.view;
    ImGui::SliderFloat("Exposure", &view.exposure, -6.0f, 6.0f, "%+.2f stops",
                       ImGuiSliderFlags_AlwaysClamp);
    int tone = static_cast<int>(view.view);
    if (ImGui::Combo("Tones", &tone, "Standard\0AgX\0ACES\0"))
        view.view = static_cast<relamp::View>(tone);
    int mode = static_cast<int>(viewer.studio.camera.mode);
    if (ImGui::Combo("Camera", &mode, "Orbit\0Walk\0"))
        viewer.studio.camera.mode = static_cast<CameraRig::Mode>(mode);
    ImGui::Checkbox("Triangles", &viewer.shown.wireframe);
    ImGui::SameLine();
    ImGui::Checkbox("Atlas", &viewer.shown.atlas);
    ImGui::SameLine();
    ImGui::Checkbox("Marks", &viewer.shown.marks);
}

void drawSide(Viewer& viewer)
{
    const VkRect2D frame = viewer.frame();
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(
        {static_cast<float>(frame.offset.x), static_cast<float>(frame.extent.height)});
    ImGui::Begin("Side", nullptr, kFixed);
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.58f);
    const std::string name = viewer.studio.path().filename().string();
    ImGui::TextUnformatted(name.empty() ? "Drop a scan into the window" : name.c_str());
    ImGui::Separator();
    constexpr ImGuiTreeNodeFlags kOpen = ImGuiTreeNodeFlags_DefaultOpen;
    if (ImGui::CollapsingHeader("Layers", kOpen)) {
        drawLayers(viewer);
        drawBefore(viewer);
    }
    if (ImGui::CollapsingHeader("View", kOpen)) drawView(viewer);
    if (ImGui::CollapsingHeader("Lights", kOpen)) drawLightPanel(viewer);
    if (ImGui::CollapsingHeader("Sky and time")) drawSkyPanel(viewer);
    if (ImGui::CollapsingHeader("Camera and proof")) drawFoundPanel(viewer);
    if (ImGui::CollapsingHeader("Solver")) drawSolverPanel(viewer);
    if (ImGui::CollapsingHeader("Save and open")) drawFilePanel(viewer);
    ImGui::PopItemWidth();
    ImGui::End();
}

/// Where the work stands, in words.
std::string statusOf(const Viewer& viewer, float& fraction)
{
    const Studio& studio = viewer.studio;
    const WorkStatus work = studio.solving();
    fraction = -1.0f;
    if (work.isBusy) {
        fraction = static_cast<float>(work.fraction);
        const char* aim = studio.stage() == Stage::reading   ? "Reading"
                          : studio.stage() == Stage::drafted ? "Solving, a draft is shown"
                          : studio.reevaluates()             ? "The albedo follows"
                                                             : "Solving";
        return work.stage.empty() ? aim : fmt::format("{}: {}", aim, work.stage);
    }
    const RelightingThread::Status relighting = studio.light().status();
    if (!relighting.stage.empty()) {
        fraction = static_cast<float>(relighting.fraction);
        return "Relighting: " + relighting.stage;
    }
    if (studio.isSaving()) return "Saving";
    switch (studio.stage()) {
    case Stage::solved:
        return "Ready"; // what failed meanwhile is told by a message
    case Stage::nothing:
        return "Drop a scan, a folder of relamp delight, lights or a timeline into the window";
    default:
        return studio.hasFailed() ? "Stopped" : "Not solved";
    }
}

void drawStatus(Viewer& viewer)
{
    const VkRect2D frame = viewer.frame();
    const auto top = static_cast<float>(frame.extent.height);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0f, top});
    ImGui::SetNextWindowSize({size.x, size.y - top});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {12.0f * viewer.scale(), 5.0f * viewer.scale()});
    ImGui::Begin("Status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
    float fraction = -1.0f;
    const std::string status = statusOf(viewer, fraction);
    if (fraction >= 0.0f) {
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, 0.0f}); // level with the words
        ImGui::ProgressBar(fraction, {120.0f * viewer.scale(), ImGui::GetTextLineHeight()}, "");
        ImGui::PopStyleVar();
        ImGui::SameLine();
    }
    ImGui::TextUnformatted(status.c_str());
    if (viewer.studio.solving().isBusy) {
        ImGui::SameLine();
        if (ImGui::SmallButton("Stop")) viewer.studio.stopSolving();
    }
    const std::string right = fmt::format("{}   F1 help", viewer.device().gpu().description().name);
    ImGui::SameLine(size.x - ImGui::CalcTextSize(right.c_str()).x - 14.0f * viewer.scale());
    ImGui::TextDisabled("%s", right.c_str());
    ImGui::End();
    ImGui::PopStyleVar();
}

/// What the person was told last, until it is clicked away.
void drawMessages(Viewer& viewer)
{
    std::deque<std::string>& messages = viewer.studio.messages;
    if (messages.empty()) return;
    const VkRect2D frame = viewer.frame();
    const float scale = viewer.scale();
    const float width = std::min(460.0f * scale, static_cast<float>(frame.extent.width) - 20.0f);
    ImGui::SetNextWindowPos({static_cast<float>(frame.offset.x) +
                                 static_cast<float>(frame.extent.width) - 10.0f * scale,
                             static_cast<float>(frame.extent.height) - 10.0f * scale},
                            ImGuiCond_Always, {1.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, 240.0f * scale});
    ImGui::Begin("Messages", nullptr,
                 (kFixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    for (const std::string& message : messages) ImGui::TextWrapped("%s", message.c_str());
    if (ImGui::SmallButton("Close")) messages.clear();
    ImGui::End();
}

} // namespace

void drawPanels(Viewer& viewer)
{
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    const bool wereEntered = (flags & ImGuiConfigFlags_NavEnableKeyboard) != 0;
    flags = viewer.shown.inPanels ? flags | ImGuiConfigFlags_NavEnableKeyboard
                                  : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
    if (viewer.shown.inPanels && !wereEntered) ImGui::SetWindowFocus("Side");
    if (viewer.shown.panels) {
        drawSide(viewer);
        drawStatus(viewer);
    }
    drawMessages(viewer);
    if (viewer.shown.help) drawHelp();
    viewer.studio.commit("Change");
    // A slider that is let go ends a step of undo.
    const bool isEditing = ImGui::IsAnyItemActive();
    if (viewer.shown.isEditing && !isEditing) viewer.studio.settle();
    viewer.shown.isEditing = isEditing;
}

void drawHelp()
{
    // In the middle of the window, panels or not: in a small one there is no other place for it.
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, window);
    ImGui::Begin("Help", nullptr,
                 (kFixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                     ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextUnformatted("Left drag turns, right or middle drag shifts, the wheel goes nearer.\n"
                           "A click chooses a lamp or a place, a double click looks there.\n"
                           "Arrow keys, page up and page down turn the camera, or move the light\n"
                           "that is chosen; with shift they turn it.");
    ImGui::Separator();
    std::vector<const Action*> listed;
    for (const Action& action : actions())
        if (*action.key != '\0' && *action.says != '\0') listed.push_back(&action);
    const size_t half = (listed.size() + 1) / 2;
    if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (size_t i = 0; i < half; ++i) {
            ImGui::TableNextRow();
            for (const size_t k : {i, i + half}) {
                if (k >= listed.size()) break;
                ImGui::TableNextColumn();
                ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s",
                                   listed[k]->key);
                ImGui::TableNextColumn();
                ImGui::Text("%s    ", listed[k]->says);
            }
        }
        ImGui::EndTable();
    }
    ImGui::End();
}
