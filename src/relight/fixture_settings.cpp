#include "base/fail.h"
#include "lights/fixture_named.h"
#include "relamp/relight.h"
#include "relight/light_emission.h"

#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr float kMostOfSetting = 1e7f; // lumens, per cent

/// What one part of a setting does to a fixture.
struct Setting
{
    bool isOn = true;
    bool isWindow = false;
    float share = 1.0f;
    EmissionWish wish;
};

[[noreturn]] void refuse(const std::string& setting)
{
    malformed(fmt::format("--fixture {}", setting),
              "is not a setting; say N=off, N=on, N=50%, N=2700K,800lm or N=window, where N is the "
              "number or the name of a fixture in lights.json, or all");
}

/// The number before `unit`, if `part` is such a thing.
std::optional<float> numberBefore(std::string_view part, std::string_view unit)
{
    if (!part.ends_with(unit)) return {};
    part.remove_suffix(unit.size());
    float value = 0.0f;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !(value >= 0.0f) ||
        value > kMostOfSetting)
        return {};
    return value;
}

bool take(std::string_view part, Setting& setting)
{
    if (part == "on") return true;
    if (part == "off") {
        setting.isOn = false;
        return true;
    }
    if (part == "window") return setting.isWindow = true;
    if (const auto percent = numberBefore(part, "%")) {
        setting.share = *percent / 100.0f;
        return true;
    }
    if (const auto lumens = numberBefore(part, "lm")) {
        setting.wish.lumens = lumens;
        return true;
    }
    const auto kelvin = numberBefore(part, "K");
    if (!kelvin || *kelvin < kColdestKelvin || *kelvin > kHottestKelvin) return false;
    setting.wish.kelvin = kelvin;
    return true;
}

Setting settingFrom(const std::string& text, std::string_view parts)
{
    Setting setting;
    while (true) {
        const size_t comma = parts.find(',');
        if (!take(parts.substr(0, comma), setting)) refuse(text);
        if (comma == std::string_view::npos) return setting;
        parts.remove_prefix(comma + 1);
    }
}

LitFixture fixtureUnder(const Setting& setting, const Lights& room, size_t place)
{
    const Fixture& captured = room.fixtures[place];
    LitFixture lit{captured, setting.isWindow};
    lit.fixture.id = room.idOf(place);
    const EmissionWish& wish = setting.wish;
    if (wish.lumens || wish.kelvin) lit.fixture.radiance = radianceUnder(wish, captured, {});
    lit.fixture.radiance *= setting.isOn ? setting.share : 0.0f;
    // A window shines by what is behind it, unless somebody says how bright it is.
    const bool isOnlyWindow = setting.isWindow && !wish.lumens && !wish.kelvin;
    if (isOnlyWindow && setting.share == 1.0f) lit.fixture.radiance = glm::vec3(0.0f);
    return lit;
}

} // namespace

Relighting darkened(const Lights& captured)
{
    Relighting lighting;
    for (size_t place = 0; place < captured.fixtures.size(); ++place) {
        Fixture& fixture = lighting.fixtures.emplace_back().fixture;
        fixture = captured.fixtures[place];
        fixture.id = captured.idOf(place);
        fixture.radiance = glm::vec3(0.0f);
    }
    return lighting;
}

Relighting asCaptured(const Lights& captured)
{
    Relighting lighting = darkened(captured);
    for (size_t place = 0; place < captured.fixtures.size(); ++place)
        lighting.fixtures[place].fixture.radiance = captured.fixtures[place].radiance;
    if (captured.sun) lighting.lights.push_back(asNewLight(*captured.sun));
    lighting.sky.radiance = captured.ambient;
    return lighting;
}

void setFixture(Relighting& lighting, const Lights& captured, const std::string& setting)
{
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) refuse(setting);
    const std::string_view all(setting);
    const Setting wanted = settingFrom(setting, all.substr(equals + 1));
    if (all.substr(0, equals) == "all") {
        for (size_t i = 0; i < captured.fixtures.size(); ++i)
            lighting.fixtures[i] = fixtureUnder(wanted, captured, i);
        return;
    }
    const size_t place = placeOfNamed(captured, all.substr(0, equals));
    if (place == captured.fixtures.size())
        malformed(fmt::format("--fixture {}", setting),
                  fmt::format("there is no fixture {}; the room's are: {}", all.substr(0, equals),
                              namesOf(captured)));
    lighting.fixtures[place] = fixtureUnder(wanted, captured, place);
}

} // namespace relamp
