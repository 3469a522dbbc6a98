#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// What the viewer remembers from one time to the next.
struct Settings
{
    int width = 1280; // of the window
    int height = 800;
    bool panels = true;
    bool walks = false;
    std::string quality = "standard";
    std::string view = "standard";
    std::vector<std::string> recent; // what was opened, the newest first
};

/// $XDG_CONFIG_HOME/relamp/viewer.json, or the same in ~/.config; empty where there is no home.
std::filesystem::path settingsFile();

/// Defaults where there is no such file or it is none of ours.
Settings readSettings(const std::filesystem::path& file);

/// Makes the folder, too. False where the place refuses it; nothing is lost by that.
bool writeSettings(const std::filesystem::path& file, const Settings& settings);
