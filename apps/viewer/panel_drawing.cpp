#include "panel_drawing.h"

#include "window.h"

#include "gpu/commands.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

namespace gpu = relamp::gpu;

namespace
{

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

gpu::Owned<VkDescriptorPool> poolOf(const WindowDevice& device)
{
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = 8;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    return gpu::owned(device.handle(), vkCreateDescriptorPool, vkDestroyDescriptorPool, info,
                      "making descriptors");
}

/// Whether a modifier is held after an event; its own key tells of the time before.
bool holds(const InputEvent& event, int mod, int left)
{
    constexpr int kRight = GLFW_KEY_RIGHT_SHIFT - GLFW_KEY_LEFT_SHIFT;
    if (event.code == left || event.code == left + kRight) return event.down;
    return (event.mods & mod) != 0;
}

void mapKeys(ImGuiIO& io)
{
    const std::array<std::pair<ImGuiKey, int>, 22> keys{{{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                         {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                         {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                         {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                         {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                         {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                                         {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                                         {ImGuiKey_Home, GLFW_KEY_HOME},
                                                         {ImGuiKey_End, GLFW_KEY_END},
                                                         {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                                         {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                         {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                         {ImGuiKey_Space, GLFW_KEY_SPACE},
                                                         {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                         {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                         {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                         {ImGuiKey_A, GLFW_KEY_A},
                                                         {ImGuiKey_C, GLFW_KEY_C},
                                                         {ImGuiKey_V, GLFW_KEY_V},
                                                         {ImGuiKey_X, GLFW_KEY_X},
                                                         {ImGuiKey_Y, GLFW_KEY_Y},
                                                         {ImGuiKey_Z, GLFW_KEY_Z}}};
    for (const auto& [imgui, glfw] : keys) io.KeyMap[imgui] = glfw;
}

} // namespace

PanelDrawing::PanelDrawing(const WindowDevice& device, Window& window, VkRenderPass pass)
    : device_(device), pool_(poolOf(device))
{
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // the viewer keeps its settings itself
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ClipboardUserData = &window;
    io.SetClipboardTextFn = [](void* to, const char* text) {
        static_cast<Window*>(to)->setClipboard(text);
    };
    io.GetClipboardTextFn = [](void* from) {
        static std::string text; // ImGui wants a pointer that lives on
        text = static_cast<Window*>(from)->clipboard();
        return text.c_str();
    };
    mapKeys(io);
    dress(window.scale());

    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.gpu().instance().handle();
    info.PhysicalDevice = device.gpu().physical();
    info.Device = device.handle();
    info.QueueFamily = device.gpu().queueFamily();
    info.Queue = device.gpu().queue();
    info.DescriptorPool = pool_.get();
    info.MinImageCount = 2;
    info.ImageCount = 2;
    info.MSAASamples = device.samples();
    ImGui_ImplVulkan_Init(&info, pass);
    gpu::Commands commands(device.gpu());
    ImGui_ImplVulkan_CreateFontsTexture(commands.handle());
    commands.run();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

PanelDrawing::~PanelDrawing()
{
    device_.gpu().wait();
    ImGui_ImplVulkan_Shutdown();
    ImGui::DestroyContext();
}

void PanelDrawing::dress(float scale)
{
    ImGuiIO& io = ImGui::GetIO();
    std::error_code ignored;
    if (std::filesystem::exists(kFont, ignored)) {
        static const ImWchar ranges[] = {0x0020, 0x00ff, 0x2010, 0x2026, 0x2190, 0x2193, 0};
        io.Fonts->AddFontFromFileTTF(kFont, 14.0f * scale, nullptr, ranges);
    } else {
        ImFontConfig config;
        config.SizePixels = 13.0f * scale;
        io.Fonts->AddFontDefault(&config);
    }
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 4.0f;
    style.PopupRounding = 4.0f;
    style.ScrollbarRounding = 4.0f;
    style.FramePadding = {8.0f, 4.0f};
    style.ItemSpacing = {8.0f, 6.0f};
    style.WindowPadding = {12.0f, 10.0f};
    const ImVec4 accent(0.95f, 0.68f, 0.25f, 1.0f); // of an incandescent lamp
    const auto tint = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    style.Colors[ImGuiCol_WindowBg] = {0.085f, 0.088f, 0.095f, 0.97f};
    style.Colors[ImGuiCol_PopupBg] = {0.11f, 0.115f, 0.125f, 0.98f};
    style.Colors[ImGuiCol_FrameBg] = {0.16f, 0.165f, 0.18f, 1.0f};
    style.Colors[ImGuiCol_FrameBgHovered] = {0.22f, 0.225f, 0.24f, 1.0f};
    style.Colors[ImGuiCol_FrameBgActive] = {0.26f, 0.265f, 0.28f, 1.0f};
    style.Colors[ImGuiCol_Header] = {0.16f, 0.165f, 0.18f, 1.0f};
    style.Colors[ImGuiCol_HeaderHovered] = tint(0.30f);
    style.Colors[ImGuiCol_HeaderActive] = tint(0.45f);
    style.Colors[ImGuiCol_Button] = {0.20f, 0.205f, 0.22f, 1.0f};
    style.Colors[ImGuiCol_ButtonHovered] = tint(0.35f);
    style.Colors[ImGuiCol_ButtonActive] = tint(0.55f);
    style.Colors[ImGuiCol_SliderGrab] = tint(0.75f);
    style.Colors[ImGuiCol_SliderGrabActive] = accent;
    style.Colors[ImGuiCol_CheckMark] = accent;
    style.Colors[ImGuiCol_NavHighlight] = accent;
    style.Colors[ImGuiCol_PlotHistogram] = tint(0.85f);
    style.Colors[ImGuiCol_Separator] = {0.22f, 0.225f, 0.24f, 1.0f};
    style.ScaleAllSizes(scale);
}

void PanelDrawing::take(const InputEvent& event)
{
    ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
    case InputEvent::Kind::key:
        if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown))
            io.KeysDown[event.code] = event.down;
        io.KeyCtrl = holds(event, GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL);
        io.KeyShift = holds(event, GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT);
        io.KeyAlt = holds(event, GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT);
        break;
    case InputEvent::Kind::text:
        io.AddInputCharactersUTF8(event.text.c_str());
        break;
    case InputEvent::Kind::button:
        if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.MouseDown))
            io.MouseDown[event.code] = event.down;
        break;
    case InputEvent::Kind::move:
        io.MousePos = {event.at.x, event.at.y};
        break;
    case InputEvent::Kind::scroll:
        io.MouseWheelH += event.at.x;
        io.MouseWheel += event.at.y;
        break;
    case InputEvent::Kind::drop:
        break;
    }
}

void PanelDrawing::begin(glm::ivec2 pixels, float seconds)
{
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(pixels.x), static_cast<float>(pixels.y)};
    io.DeltaTime = std::clamp(seconds, 1e-4f, 0.25f);
    ImGui_ImplVulkan_NewFrame();
    ImGui::NewFrame();
}

void PanelDrawing::end()
{
    ImGui::Render();
}

void PanelDrawing::draw(VkCommandBuffer commands)
{
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}
