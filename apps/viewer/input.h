#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>

/// What a person, or a script in their place, does to the window.
struct InputEvent
{
    enum class Kind { key, text, button, move, scroll, drop };
    Kind kind = Kind::move;
    int code = 0; // GLFW's, of a key or button
    bool down = false;
    int mods = 0;       // GLFW's, of a key or button
    glm::vec2 at{0.0f}; // pixels of the window, or steps of a wheel
    std::string text{}; // typed, or the file that was dropped
};

/// A key with what is held beside it, as in "ctrl+shift+z".
struct KeyChord
{
    int key = 0; // GLFW's
    int mods = 0;

    bool operator==(const KeyChord&) const = default;
};

/// None where there is no such key. "+" and "-" are keys, too.
std::optional<KeyChord> chordNamed(const std::string& name);
std::string nameOf(const KeyChord& chord);
