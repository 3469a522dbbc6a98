#include "light_document.h"

#include "relamp/error.h"
#include "relamp/names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <glm/geometric.hpp>

namespace
{

using nlohmann::ordered_json;
using relamp::LightType;

constexpr std::array<const char*, 5> kUnits{"lumens", "candela", "watts", "nits", "lux"};
constexpr std::array<const char*, 3> kRgbUnits{"intensity", "radiance", "irradiance"};

/// The float in as few digits as tell it apart, as people write numbers.
double plain(float value)
{
    return std::stod(fmt::format("{}", value));
}

ordered_json listOf(glm::vec3 v)
{
    return ordered_json::array({plain(v.x), plain(v.y), plain(v.z)});
}

glm::vec3 vec3From(const ordered_json& list)
{
    return {list.at(0).get<float>(), list.at(1).get<float>(), list.at(2).get<float>()};
}

/// Reads a key where it is there.
template<class T>
void take(const ordered_json& item, const char* key, T& value)
{
    const auto found = item.find(key);
    if (found == item.end()) return;
    if constexpr (std::is_same_v<T, glm::vec3>)
        value = vec3From(*found);
    else
        value = found->get<T>();
}

template<class T>
void take(const ordered_json& item, const char* key, std::optional<T>& value)
{
    if (!item.contains(key)) return;
    value.emplace();
    take(item, key, *value);
}

ordered_json jsonOf(const LampItem& lamp)
{
    ordered_json item;
    if (!lamp.name.empty()) item["name"] = lamp.name;
    item["type"] = relamp::nameOf(lamp.type);
    if (lamp.type != LightType::sun) item["position"] = listOf(lamp.position);
    if (lamp.aims() || !lamp.ies.empty()) item["direction"] = listOf(lamp.direction);
    if (lamp.type == LightType::rectangle) {
        item["size"] = {plain(lamp.size.x), plain(lamp.size.y)};
        if (lamp.along != glm::vec3(0.0f)) item["along"] = listOf(lamp.along);
    } else if (lamp.type == LightType::sun) {
        item["angle"] = plain(lamp.angle);
    } else {
        item["radius"] = plain(lamp.radius);
    }
    if (lamp.type == LightType::spot) {
        item["cone"] = plain(lamp.cone);
        item["blend"] = plain(lamp.blend);
    }
    if (!lamp.ies.empty()) item["ies"] = lamp.ies;
    if (lamp.takesRgb()) {
        item[lamp.unit] = listOf(lamp.rgb);
    } else {
        if (lamp.unit != "ies") item[lamp.unit] = plain(lamp.amount);
        lamp.byKelvin ? item["kelvin"] = plain(lamp.kelvin) : item["colour"] = listOf(lamp.colour);
    }
    if (!lamp.on) item["on"] = false;
    if (lamp.dim != 1.0f) item["dim"] = plain(lamp.dim);
    return item;
}

ordered_json jsonOf(const FixtureItem& fixture, int id)
{
    ordered_json item;
    item["id"] = id;
    item["on"] = fixture.on;
    if (fixture.radiance) item["radiance"] = listOf(*fixture.radiance);
    if (fixture.lumens) item["lumens"] = plain(*fixture.lumens);
    if (fixture.kelvin) item["kelvin"] = plain(*fixture.kelvin);
    if (fixture.dim != 1.0f) item["dim"] = plain(fixture.dim);
    if (fixture.window) item["window"] = true;
    return item;
}

ordered_json jsonOf(const SkyItem& sky)
{
    ordered_json item;
    if (sky.radiance)
        item["radiance"] = listOf(*sky.radiance);
    else {
        item["nits"] = plain(sky.nits);
        item["colour"] = listOf(sky.colour);
    }
    if (!sky.environment.empty()) item["environment"] = sky.environment;
    if (sky.turn != 0.0f) item["turn"] = plain(sky.turn);
    return item;
}

void takeUnit(const ordered_json& item, LampItem& lamp)
{
    lamp.unit = lamp.ies.empty() ? lamp.unit : "ies";
    for (const char* unit : kUnits)
        if (item.contains(unit)) {
            lamp.unit = unit;
            take(item, unit, lamp.amount);
        }
    for (const char* unit : kRgbUnits)
        if (item.contains(unit)) {
            lamp.unit = unit;
            take(item, unit, lamp.rgb);
        }
}

LampItem lampFrom(const ordered_json& item)
{
    LampItem lamp;
    lamp.type = lightTypeNamed(item.value("type", "point"));
    lamp.radius = 0.0f;
    lamp.cone = 90.0f;
    lamp.byKelvin = item.contains("kelvin");
    take(item, "name", lamp.name);
    take(item, "position", lamp.position);
    take(item, "direction", lamp.direction);
    take(item, "along", lamp.along);
    if (item.contains("size"))
        lamp.size = {item.at("size").at(0).get<float>(), item.at("size").at(1).get<float>()};
    take(item, "radius", lamp.radius);
    take(item, "cone", lamp.cone);
    take(item, "blend", lamp.blend);
    take(item, "angle", lamp.angle);
    take(item, "ies", lamp.ies);
    take(item, "kelvin", lamp.kelvin);
    take(item, "colour", lamp.colour);
    take(item, "on", lamp.on);
    take(item, "dim", lamp.dim);
    takeUnit(item, lamp);
    const float length = glm::length(lamp.direction);
    // What was saved has a length of 1 but for rounding, and stays as it is.
    if (length > 0.0f && std::abs(length - 1.0f) > 1e-4f) lamp.direction /= length;
    return lamp;
}

/// The sun as delight writes it: where it stands.
LampItem sunFrom(const ordered_json& item)
{
    LampItem sun{.name = "sun", .type = LightType::sun, .unit = "irradiance"};
    take(item, "direction", sun.direction);
    take(item, "irradiance", sun.rgb);
    sun.direction = -glm::normalize(sun.direction);
    return sun;
}

void takeFixture(const ordered_json& item, FixtureItem& fixture)
{
    fixture.on = true;
    take(item, "on", fixture.on);
    take(item, "dim", fixture.dim);
    take(item, "kelvin", fixture.kelvin);
    take(item, "lumens", fixture.lumens);
    take(item, "radiance", fixture.radiance);
    take(item, "window", fixture.window);
}

/// By number, by name, or by its own place in the list.
size_t placeMeant(const ordered_json& item, size_t place, const relamp::Lights& captured)
{
    if (item.contains("id")) return captured.placeOf(item["id"].get<int>());
    if (!item.contains("name")) return place;
    size_t named = 0;
    while (named < captured.fixtures.size() && captured.nameOf(named) != item["name"]) ++named;
    return named;
}

void takeFixtures(const ordered_json& list, const relamp::Lights& captured, LightDocument& document,
                  std::vector<std::string>& notes)
{
    if (list.is_string()) {
        for (FixtureItem& fixture : document.fixtures) fixture.on = list == "on";
        return;
    }
    for (size_t i = 0; i < list.size(); ++i) {
        const size_t place = placeMeant(list[i], i, captured);
        if (place < document.fixtures.size())
            takeFixture(list[i], document.fixtures[place]);
        else
            notes.push_back(
                fmt::format("fixture {} of the list is none of this room's; it was left out", i));
    }
}

} // namespace

bool LampItem::takesRgb() const
{
    return std::any_of(kRgbUnits.begin(), kRgbUnits.end(),
                       [&](const char* name_) { return unit == name_; });
}

bool LampItem::aims() const
{
    return type != LightType::point && type != LightType::sphere;
}

std::vector<FixtureItem> carriedOver(const std::vector<FixtureItem>& items,
                                     const std::vector<int>& numbers,
                                     const relamp::Lights& captured, const FixtureItem& otherwise)
{
    std::vector<FixtureItem> next(captured.fixtures.size(), otherwise);
    for (size_t i = 0; i < std::min(items.size(), numbers.size()); ++i) {
        const size_t place = captured.placeOf(numbers[i]);
        if (place < next.size()) next[place] = items[i];
    }
    return next;
}

std::vector<int> numbersOf(const relamp::Lights& captured)
{
    std::vector<int> numbers;
    for (size_t place = 0; place < captured.fixtures.size(); ++place)
        numbers.push_back(captured.idOf(place));
    return numbers;
}

bool ScannedItems::isAsFound() const
{
    return sun == 1.0f && sunColour == glm::vec3(1.0f) && !ambient &&
           std::all_of(fixtures.begin(), fixtures.end(),
                       [](const FixtureItem& item) { return item == kAsFound; });
}

relamp::Lights skyUnder(const ScannedItems& scanned, const relamp::Lights& found)
{
    relamp::Lights lights = found;
    if (lights.sun) lights.sun->irradiance *= scanned.sun * scanned.sunColour;
    if (scanned.ambient) lights.ambient = *scanned.ambient;
    return lights;
}

void followSky(LightDocument& light, const relamp::Lights& before, const relamp::Lights& after)
{
    for (LampItem& lamp : light.lamps)
        if (before.sun && lamp.type == LightType::sun && lamp.unit == "irradiance" &&
            lamp.rgb == before.sun->irradiance)
            lamp.rgb = after.sun->irradiance;
    if (light.sky.radiance == before.ambient && light.sky.environment.empty())
        light.sky.radiance = after.ambient;
}

relamp::Lights lightsUnder(const ScannedItems& scanned, const LightDocument& light,
                           const relamp::Lights& found)
{
    LightDocument fixtures{.fixtures = scanned.fixtures};
    fixtures.whiteNits = light.whiteNits;
    fixtures.whiteKelvin = light.whiteKelvin;
    std::vector<std::string> notes;
    relamp::RelightingReader reader;
    const relamp::Relighting lit = lightingOf(fixtures, {}, found, notes, reader);
    relamp::Lights lights = skyUnder(scanned, found);
    for (size_t i = 0; i < lights.fixtures.size(); ++i)
        lights.fixtures[i].radiance = lit.fixtures[i].fixture.radiance;
    return lights;
}

LightDocument documentOf(const relamp::Lights& captured)
{
    LightDocument document;
    document.fixtures.resize(captured.fixtures.size(), FixtureItem{.on = true});
    document.sky.radiance = captured.ambient;
    if (captured.sun) {
        document.lamps.push_back({.name = "sun",
                                  .type = LightType::sun,
                                  .direction = -captured.sun->direction,
                                  .unit = "irradiance",
                                  .rgb = captured.sun->irradiance});
    }
    return document;
}

std::string textOf(const LightDocument& document, const relamp::Lights& captured)
{
    ordered_json top;
    top["format"] = "relamp lights 1";
    if (document.whiteNits) top["white"]["nits"] = plain(*document.whiteNits);
    if (document.whiteKelvin) top["white"]["kelvin"] = plain(*document.whiteKelvin);
    top["lights"] = ordered_json::array();
    for (const LampItem& lamp : document.lamps) top["lights"].push_back(jsonOf(lamp));
    top["fixtures"] = ordered_json::array();
    for (size_t i = 0; i < document.fixtures.size(); ++i)
        top["fixtures"].push_back(jsonOf(document.fixtures[i], captured.idOf(i)));
    top["sky"] = jsonOf(document.sky);
    return top.dump(1, '\t') + "\n";
}

LightDocument documentFrom(const std::string& text, const std::filesystem::path& file,
                           const relamp::Lights& captured, std::vector<std::string>& notes)
{
    // The library says what is wrong, with line and key; what it took is well formed.
    static_cast<void>(relamp::RelightingReader().read(text, file, captured, notes));
    const ordered_json top = ordered_json::parse(text);
    LightDocument document;
    document.fixtures.resize(captured.fixtures.size());
    if (top.contains("fixtures")) takeFixtures(top["fixtures"], captured, document, notes);
    if (top.contains("lights"))
        for (const ordered_json& item : top["lights"])
            if (!item.contains("fixture")) document.lamps.push_back(lampFrom(item));
    if (top.contains("sun")) document.lamps.push_back(sunFrom(top["sun"]));
    if (top.contains("white")) {
        take(top["white"], "nits", document.whiteNits);
        take(top["white"], "kelvin", document.whiteKelvin);
    }
    if (top.contains("ambient")) document.sky.radiance = vec3From(top["ambient"]);
    if (top.contains("sky")) {
        const ordered_json& sky = top["sky"];
        take(sky, "nits", document.sky.nits);
        take(sky, "colour", document.sky.colour);
        take(sky, "radiance", document.sky.radiance);
        take(sky, "environment", document.sky.environment);
        take(sky, "turn", document.sky.turn);
        if (!sky.contains("nits") && !document.sky.radiance)
            document.sky.radiance = glm::vec3(1.0f);
    }
    return document;
}

relamp::Relighting lightingOf(const LightDocument& document, const std::filesystem::path& folder,
                              const relamp::Lights& captured, std::vector<std::string>& notes,
                              relamp::RelightingReader& reader)
{
    return reader.read(textOf(document, captured), folder / "lights.json", captured, notes);
}

LightType lightTypeNamed(const std::string& name)
{
    if (const auto type = relamp::named<LightType>(name)) return *type;
    throw relamp::Error(relamp::ErrorCode::malformed,
                        fmt::format("\"{}\" is no kind of light; there are {}", name,
                                    relamp::namesInWords<LightType>()));
}
