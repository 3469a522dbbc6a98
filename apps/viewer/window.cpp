#include "window.h"

#include "relamp/error.h"

#include <array>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <glm/common.hpp>

namespace
{

/// Of ImGui's cursors, in their order: arrow, text, all ways, up and down, left and right …
constexpr std::array<int, 8> kPointers{GLFW_ARROW_CURSOR,   GLFW_IBEAM_CURSOR,   GLFW_ARROW_CURSOR,
                                       GLFW_VRESIZE_CURSOR, GLFW_HRESIZE_CURSOR, GLFW_ARROW_CURSOR,
                                       GLFW_ARROW_CURSOR,   GLFW_HAND_CURSOR};

Window& of(GLFWwindow* window)
{
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

/// UTF-8 of a character.
std::string utf8(unsigned int c)
{
    const auto byte = [](unsigned int bits) { return static_cast<char>(bits); };
    if (c < 0x80) return {byte(c)};
    if (c < 0x800) return {byte(0xc0 | c >> 6), byte(0x80 | (c & 0x3f))};
    if (c < 0x10000)
        return {byte(0xe0 | c >> 12), byte(0x80 | (c >> 6 & 0x3f)), byte(0x80 | (c & 0x3f))};
    return {byte(0xf0 | c >> 18), byte(0x80 | (c >> 12 & 0x3f)), byte(0x80 | (c >> 6 & 0x3f)),
            byte(0x80 | (c & 0x3f))};
}

[[noreturn]] void noWindow(const std::string& sentence)
{
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw relamp::Error(relamp::ErrorCode::unsupported,
                        reason == nullptr ? sentence : fmt::format("{} ({})", sentence, reason));
}

} // namespace

Window::Window(glm::ivec2 size, const std::string& title)
{
    if (glfwInit() == GLFW_FALSE)
        noWindow(
            "no window can be opened: there is no display. Run it in a desktop session, or under "
            "xvfb-run");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        glfwTerminate();
        noWindow("no window can be opened on this display");
    }
    for (const int shape : kPointers) pointers_.push_back(glfwCreateStandardCursor(shape));
    listen();
}

Window::~Window()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::listen()
{
    using Kind = InputEvent::Kind;
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
        if (key != GLFW_KEY_UNKNOWN)
            of(w).add(
                {.kind = Kind::key, .code = key, .down = action != GLFW_RELEASE, .mods = mods});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned int c) {
        of(w).add({.kind = Kind::text, .text = utf8(c)});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
        of(w).add(
            {.kind = Kind::button, .code = button, .down = action != GLFW_RELEASE, .mods = mods});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        of(w).add({.kind = Kind::move, .at = glm::vec2(x, y) * of(w).pixelsPerUnit()});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        of(w).add({.kind = Kind::scroll, .at = {static_cast<float>(x), static_cast<float>(y)}});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
        for (int i = 0; i < count; ++i) of(w).add({.kind = Kind::drop, .text = files[i]});
    });
}

glm::ivec2 Window::pixels() const
{
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

glm::vec2 Window::pixelsPerUnit() const
{
    glm::ivec2 units(1);
    glfwGetWindowSize(window_, &units.x, &units.y);
    return glm::vec2(pixels()) / glm::max(glm::vec2(units), 1.0f);
}

float Window::scale() const
{
    glm::vec2 scale(1.0f);
    glfwGetWindowContentScale(window_, &scale.x, &scale.y);
    return scale.x > 0.0f ? scale.x : 1.0f;
}

bool Window::isClosed() const
{
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::resize(glm::ivec2 size)
{
    const glm::vec2 perUnit = pixelsPerUnit();
    glfwSetWindowSize(window_, static_cast<int>(static_cast<float>(size.x) / perUnit.x),
                      static_cast<int>(static_cast<float>(size.y) / perUnit.y));
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setPointer(int imguiCursor)
{
    if (imguiCursor >= 0 && static_cast<size_t>(imguiCursor) < pointers_.size())
        glfwSetCursor(window_, pointers_[static_cast<size_t>(imguiCursor)]);
}

std::string Window::clipboard() const
{
    const char* text = glfwGetClipboardString(window_);
    return text == nullptr ? "" : text;
}

void Window::setClipboard(const char* text)
{
    glfwSetClipboardString(window_, text);
}

std::vector<InputEvent> Window::events(double seconds)
{
    seconds > 0.0 ? glfwWaitEventsTimeout(seconds) : glfwPollEvents();
    return std::exchange(events_, {});
}

void Window::wake()
{
    glfwPostEmptyEvent();
}
