#include "relamp/lights.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"
#include "lights/fixtures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

#include <fmt/format.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kFormat = "relamp lights 1";
constexpr size_t kLargestFile = size_t{16}
                                << 20; // bytes; a thousand lights take a quarter of one MiB
constexpr double kLargestNumber = 1e9; // of any unit; its square is still a float
constexpr float kLargestShare = 1e6f;  // of a fixture; 1 is all of it
constexpr float kDark = 1e-9f;         // intensity; what is less is switched off

// ---- writing

ordered_json toJson(glm::vec3 v)
{
    return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

ordered_json facingAsJson(glm::vec3 normal)
{
    return normal == glm::vec3(0.0f) ? ordered_json("omni") : toJson(normal);
}

ordered_json toJson(const Fixture& fixture, size_t id)
{
    ordered_json object{{"id", id},
                        {"centre", toJson(fixture.centre)},
                        {"normal", facingAsJson(fixture.normal)},
                        {"area", shortest(fixture.area)},
                        {"radiance", toJson(fixture.radiance)},
                        {"power", toJson(fixture.power())},
                        {"on", true}};
    if (fixture.error != glm::vec3(0.0f)) object["error"] = toJson(fixture.error);
    if (!fixture.determined) object["determined"] = false;
    return object;
}

/// What part of its fixture's light a point sends, by channel; none for a light of its own.
std::optional<glm::vec3> shareOf(const PointLight& light, const std::vector<Fixture>& fixtures)
{
    if (light.fixture < 0) return {};
    const glm::vec3 whole = intensityOf(fixtures[static_cast<size_t>(light.fixture)]);
    glm::vec3 share(0.0f);
    for (int c = 0; c < 3; ++c) {
        if (light.intensity[c] == 0.0f) continue;
        share[c] = light.intensity[c] / whole[c];
        if (!(share[c] <= kLargestShare)) return {}; // the fixture itself does not shine so
    }
    return share;
}

ordered_json toJson(const PointLight& light, const std::vector<Fixture>& fixtures)
{
    ordered_json object{{"type", "point"},
                        {"position", toJson(light.position)},
                        {"normal", facingAsJson(light.normal)},
                        {"radius", shortest(light.radius)}};
    if (const auto share = shareOf(light, fixtures)) {
        object["fixture"] = light.fixture;
        object["share"] = toJson(*share);
    } else {
        object["intensity"] = toJson(light.intensity);
    }
    return object;
}

ordered_json toJson(const Sun& sun)
{
    ordered_json object{{"direction", toJson(sun.direction)},
                        {"irradiance", toJson(sun.irradiance)}};
    if (sun.error != glm::vec3(0.0f)) object["error"] = toJson(sun.error);
    if (!sun.determined) object["determined"] = false;
    return object;
}

// ---- reading

/// An object of the file and how to call it in a sentence.
struct Item
{
    const json& object;
    std::string what;

    [[nodiscard]] const json* find(const char* key) const
    {
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }
};

/// A value as it stands in a sentence.
std::string printable(const json& value)
{
    return dumpJson(value).substr(0, 40);
}

float numberFrom(const json& value, const std::string& what)
{
    if (!value.is_number()) malformed(what, "must be a number");
    const auto number = value.get<double>();
    if (!(std::abs(number) <= kLargestNumber))
        malformed(what, "must be a number between -1e9 and 1e9");
    return static_cast<float>(number);
}

glm::vec3 vectorFrom(const json& value, const std::string& what)
{
    if (!value.is_array() || value.size() != 3) malformed(what, "must be a list of three numbers");
    return {numberFrom(value[0], what), numberFrom(value[1], what), numberFrom(value[2], what)};
}

glm::vec3 vectorAt(const Item& item, const char* key)
{
    const json* value = item.find(key);
    if (value == nullptr) malformed(item.what, fmt::format("\"{}\" is missing", key));
    return vectorFrom(*value, fmt::format("{}: \"{}\"", item.what, key));
}

glm::vec3 lightAt(const Item& item, const char* key)
{
    const glm::vec3 rgb = vectorAt(item, key);
    if (std::min({rgb.r, rgb.g, rgb.b}) < 0.0f)
        malformed(item.what, fmt::format("\"{}\" must not be negative", key));
    return rgb;
}

glm::vec3 facingAt(const Item& item)
{
    const json* value = item.find("normal");
    if (value == nullptr || *value == "omni") return glm::vec3(0.0f);
    const glm::vec3 normal = vectorFrom(*value, item.what + ": \"normal\"");
    const float length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    return length > 0.0f ? normal / length : normal;
}

float sizeAt(const Item& item, const char* key)
{
    const json* value = item.find(key);
    if (value == nullptr) return 0.0f;
    const float size = numberFrom(*value, fmt::format("{}: \"{}\"", item.what, key));
    if (size < 0.0f) malformed(item.what, fmt::format("\"{}\" must not be negative", key));
    return size;
}

void warnOfUnknown(const Item& item, std::initializer_list<const char*> known,
                   std::vector<std::string>& warnings)
{
    for (const auto& [key, value] : item.object.items()) {
        const auto isKey = [&, name = key](const char* k) { return name == k; };
        if (std::none_of(known.begin(), known.end(), isKey))
            warnings.push_back(
                fmt::format("{}: \"{}\" is not known and was passed over", item.what, key));
    }
}

Fixture fixtureFrom(const Item& item, std::vector<std::string>& warnings)
{
    warnOfUnknown(
        item, {"id", "centre", "normal", "area", "radiance", "power", "error", "determined", "on"},
        warnings);
    Fixture fixture;
    fixture.centre = vectorAt(item, "centre");
    fixture.normal = facingAt(item);
    fixture.area = sizeAt(item, "area");
    fixture.radiance = lightAt(item, "radiance");
    const json* on = item.find("on");
    if (on != nullptr && !on->is_boolean()) malformed(item.what, "\"on\" must be true or false");
    if (on != nullptr && *on == false) fixture.radiance = glm::vec3(0.0f);
    return fixture;
}

Sun sunFrom(const Item& item, std::vector<std::string>& warnings)
{
    if (!item.object.is_object()) malformed(item.what, "must be an object in { }");
    warnOfUnknown(item, {"direction", "irradiance", "error", "determined"}, warnings);
    Sun sun;
    const glm::vec3 way = vectorAt(item, "direction");
    const float length = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
    if (!(length > 0.0f)) malformed(item.what, "\"direction\" must point somewhere");
    sun.direction = way / length;
    sun.irradiance = lightAt(item, "irradiance");
    return sun;
}

int fixtureAt(const Item& item, size_t fixtures)
{
    const json& value = *item.find("fixture");
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= fixtures)
        malformed(item.what, fmt::format("\"fixture\" is {}; it must be the place of one of the {} "
                                         "fixtures in their list, counted from 0",
                                         printable(value), fixtures));
    return value.get<int>();
}

/// What a light sends: a share of its fixture's, so that whoever edits the fixture edits it too, or
/// an intensity of its own.
void takeIntensity(const Item& item, const std::vector<Fixture>& fixtures, PointLight& light)
{
    if (item.find("fixture") == nullptr) {
        if (item.find("share") != nullptr)
            malformed(item.what, "\"share\" is that of a fixture; name it as \"fixture\"");
        light.intensity = lightAt(item, "intensity");
        return;
    }
    if (item.find("intensity") != nullptr)
        malformed(item.what,
                  "\"intensity\" is for lights without \"fixture\"; a light of a fixture "
                  "has a \"share\" of it");
    light.fixture = fixtureAt(item, fixtures.size());
    light.intensity =
        lightAt(item, "share") * intensityOf(fixtures[static_cast<size_t>(light.fixture)]);
}

PointLight lightFrom(const Item& item, const std::vector<Fixture>& fixtures,
                     std::vector<std::string>& warnings)
{
    warnOfUnknown(item, {"type", "position", "normal", "intensity", "radius", "fixture", "share"},
                  warnings);
    if (const json* type = item.find("type"); type != nullptr && *type != "point")
        malformed(item.what,
                  fmt::format("\"type\" is {}; this version knows \"point\"", printable(*type)));
    PointLight light;
    light.position = vectorAt(item, "position");
    light.normal = facingAt(item);
    light.radius = sizeAt(item, "radius");
    takeIntensity(item, fixtures, light);
    return light;
}

/// Lights that do not shine, say because their fixture is off, are none.
void dropDark(std::vector<PointLight>& lights)
{
    std::erase_if(lights, [](const PointLight& light) {
        return std::max({light.intensity.r, light.intensity.g, light.intensity.b}) < kDark;
    });
}

/// Calls `take(item)` for every object of a list that the file may have.
template<class Take>
void forEachItem(const Item& top, const char* key, const std::string& what, const Take& take)
{
    if (top.find(key) == nullptr) return;
    const json& list = *top.find(key);
    if (!list.is_array()) malformed(top.what, fmt::format("\"{}\" must be a list", key));
    for (size_t i = 0; i < list.size(); ++i) {
        const Item item{list[i], fmt::format("{} {}", what, i)};
        if (!item.object.is_object()) malformed(item.what, "must be an object in { }");
        take(item);
    }
}

void addLightsOfWholeFixtures(Lights& lights)
{
    std::vector<bool> isTakenApart(lights.fixtures.size(), false);
    for (const PointLight& light : lights.points)
        if (light.fixture >= 0) isTakenApart[static_cast<size_t>(light.fixture)] = true;
    for (size_t i = 0; i < lights.fixtures.size(); ++i)
        if (!isTakenApart[i])
            lights.points.push_back(pointLightOf(lights.fixtures[i], static_cast<int>(i)));
}

} // namespace

std::string lightsAsJson(const Lights& lights)
{
    ordered_json document{{"format", kFormat},
                          {"units",
                           "metres, Y up; radiance 1 = the texture's white; intensity in radiance "
                           "m^2, power in radiance m^2 sr; linear Rec. 709"}};
    document["fixtures"] = ordered_json::array();
    for (size_t i = 0; i < lights.fixtures.size(); ++i)
        document["fixtures"].push_back(toJson(lights.fixtures[i], i));
    document["lights"] = ordered_json::array();
    for (const PointLight& light : lights.points)
        document["lights"].push_back(toJson(light, lights.fixtures));
    document["ambient"] = toJson(lights.ambient);
    if (lights.sun) document["sun"] = toJson(*lights.sun);
    return document.dump(1, '\t') + "\n";
}

Lights readLights(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    const std::string name = file.string();
    const std::vector<std::byte> bytes = readFile(file, kLargestFile);
    const json document =
        parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
    const Item top{document, name};
    warnOfUnknown(top, {"format", "units", "fixtures", "lights", "ambient", "sun"}, warnings);
    if (const json* format = top.find("format"); format != nullptr && *format != kFormat)
        malformed(name, fmt::format("its format is {}, this version reads \"{}\"",
                                    printable(*format), kFormat));

    Lights lights;
    forEachItem(top, "fixtures", name + ": fixture",
                [&](const Item& item) { lights.fixtures.push_back(fixtureFrom(item, warnings)); });
    forEachItem(top, "lights", name + ": light", [&](const Item& item) {
        lights.points.push_back(lightFrom(item, lights.fixtures, warnings));
    });
    addLightsOfWholeFixtures(lights);
    dropDark(lights.points);
    if (top.find("ambient") != nullptr) lights.ambient = lightAt(top, "ambient");
    if (const json* sun = top.find("sun")) lights.sun = sunFrom({*sun, name + ": sun"}, warnings);
    if (lights.points.empty() && lights.ambient == glm::vec3(0.0f) && !lights.sun)
        malformed(name, "holds no light: it needs \"lights\", \"fixtures\", \"ambient\" or "
                        "\"sun\" that shine");
    return lights;
}

} // namespace relamp
