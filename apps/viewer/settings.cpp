#include "settings.h"

#include "text_file.h"

#include "relamp/error.h"

#include <algorithm>
#include <cstdlib>

#include <nlohmann/json.hpp>

namespace
{

constexpr size_t kRecent = 8;

/// A side of the window; a number that is no side at all becomes one.
int pixelsFrom(const nlohmann::json& json, const char* key, int otherwise, int least)
{
    constexpr double kMost = 16384.0;
    return static_cast<int>(std::clamp(json.value(key, static_cast<double>(otherwise)),
                                       static_cast<double>(least), kMost));
}

} // namespace

std::filesystem::path settingsFile()
{
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (config != nullptr && *config == '/')
        return std::filesystem::path(config) / "relamp" / "viewer.json";
    if (home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".config" / "relamp" / "viewer.json";
    return {};
}

Settings readSettings(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
    try {
        const nlohmann::json json = nlohmann::json::parse(textFrom(file));
        Settings settings;
        settings.width = pixelsFrom(json, "width", settings.width, 320);
        settings.height = pixelsFrom(json, "height", settings.height, 240);
        settings.panels = json.value("panels", settings.panels);
        settings.walks = json.value("walks", settings.walks);
        settings.quality = json.value("quality", settings.quality);
        settings.view = json.value("view", settings.view);
        settings.recent = json.value("recent", settings.recent);
        if (settings.recent.size() > kRecent) settings.recent.resize(kRecent);
        return settings;
    } catch (const nlohmann::json::exception&) {
        return {};
    } catch (const relamp::Error&) {
        return {};
    }
}

bool writeSettings(const std::filesystem::path& file, const Settings& settings)
{
    if (file.empty()) return false;
    std::error_code failure;
    std::filesystem::create_directories(file.parent_path(), failure);
    const nlohmann::ordered_json json{{"width", settings.width},     {"height", settings.height},
                                      {"panels", settings.panels},   {"walks", settings.walks},
                                      {"quality", settings.quality}, {"view", settings.view},
                                      {"recent", settings.recent}};
    try {
        writeText(file, json.dump(1, '\t', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const relamp::Error&) {
        return false;
    }
    return true;
}
