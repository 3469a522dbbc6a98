#include "input.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <GLFW/glfw3.h>

namespace
{

struct NamedKey
{
    std::string_view name;
    int key;
};

constexpr std::array<NamedKey, 34> kKeys{{{"space", GLFW_KEY_SPACE},
                                          {"enter", GLFW_KEY_ENTER},
                                          {"tab", GLFW_KEY_TAB},
                                          {"escape", GLFW_KEY_ESCAPE},
                                          {"backspace", GLFW_KEY_BACKSPACE},
                                          {"delete", GLFW_KEY_DELETE},
                                          {"insert", GLFW_KEY_INSERT},
                                          {"home", GLFW_KEY_HOME},
                                          {"end", GLFW_KEY_END},
                                          {"pageup", GLFW_KEY_PAGE_UP},
                                          {"pagedown", GLFW_KEY_PAGE_DOWN},
                                          {"left", GLFW_KEY_LEFT},
                                          {"right", GLFW_KEY_RIGHT},
                                          {"up", GLFW_KEY_UP},
                                          {"down", GLFW_KEY_DOWN},
                                          {"+", GLFW_KEY_EQUAL},
                                          {"-", GLFW_KEY_MINUS},
                                          {",", GLFW_KEY_COMMA},
                                          {".", GLFW_KEY_PERIOD},
                                          {"/", GLFW_KEY_SLASH},
                                          {"[", GLFW_KEY_LEFT_BRACKET},
                                          {"]", GLFW_KEY_RIGHT_BRACKET},
                                          {"f1", GLFW_KEY_F1},
                                          {"f2", GLFW_KEY_F2},
                                          {"f3", GLFW_KEY_F3},
                                          {"f4", GLFW_KEY_F4},
                                          {"f5", GLFW_KEY_F5},
                                          {"f6", GLFW_KEY_F6},
                                          {"f7", GLFW_KEY_F7},
                                          {"f8", GLFW_KEY_F8},
                                          {"f9", GLFW_KEY_F9},
                                          {"f10", GLFW_KEY_F10},
                                          {"f11", GLFW_KEY_F11},
                                          {"f12", GLFW_KEY_F12}}};

std::optional<int> keyNamed(std::string_view name)
{
    if (name.size() == 1 && (std::isalnum(static_cast<unsigned char>(name[0])) != 0))
        return std::toupper(static_cast<unsigned char>(name[0])); // GLFW counts as ASCII
    for (const NamedKey& key : kKeys)
        if (key.name == name) return key.key;
    return std::nullopt;
}

constexpr std::array<NamedKey, 3> kMods{
    {{"ctrl+", GLFW_MOD_CONTROL}, {"shift+", GLFW_MOD_SHIFT}, {"alt+", GLFW_MOD_ALT}}};

} // namespace

std::optional<KeyChord> chordNamed(const std::string& name)
{
    std::string left = name;
    std::transform(left.begin(), left.end(), left.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    KeyChord chord;
    for (bool found = true; found;) {
        found = false;
        for (const NamedKey& mod : kMods)
            if (left.size() > mod.name.size() && left.starts_with(mod.name)) {
                chord.mods |= mod.key;
                left = left.substr(mod.name.size());
                found = true;
            }
    }
    const std::optional<int> key = keyNamed(left);
    if (!key) return std::nullopt;
    chord.key = *key;
    return chord;
}

std::string nameOf(const KeyChord& chord)
{
    std::string name;
    for (const NamedKey& mod : kMods)
        if ((chord.mods & mod.key) != 0) name += mod.name;
    for (const NamedKey& key : kKeys)
        if (key.key == chord.key) return name + std::string(key.name);
    return name + static_cast<char>(std::tolower(chord.key));
}
