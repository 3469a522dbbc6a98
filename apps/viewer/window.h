#pragma once

#include "input.h"

#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

struct GLFWwindow;

/// The window, and what is done to it.
class Window
{
public:
    /// Throws relamp::Error with a sentence where there is no display.
    Window(glm::ivec2 size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] GLFWwindow* get() const { return window_; }
    [[nodiscard]] glm::ivec2 pixels() const; // 0 where it is an icon
    /// How much larger things are drawn than on a screen of 96 dots an inch.
    [[nodiscard]] float scale() const;
    [[nodiscard]] bool isClosed() const;
    void resize(glm::ivec2 size);
    void setTitle(const std::string& title);
    void setPointer(int imguiCursor);
    [[nodiscard]] std::string clipboard() const;
    void setClipboard(const char* text);

    /// What happened since the last call. Waits up to `seconds` for something; `wake` ends that.
    std::vector<InputEvent> events(double seconds);
    static void wake(); // from any thread

    /// Pixels a unit of GLFW's coordinates.
    [[nodiscard]] glm::vec2 pixelsPerUnit() const;
    void add(InputEvent event) { events_.push_back(std::move(event)); }

private:
    void listen();

    GLFWwindow* window_ = nullptr;
    std::vector<InputEvent> events_;
    std::vector<struct GLFWcursor*> pointers_;
};
