#include "relamp/lights.h"

#include "base/fail.h"
#include "base/json.h"
#include "lights/fixtures.h"
#include "lights/json_document.h"
#include "lights/sun_item.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using nlohmann::ordered_json;

constexpr float kLargestShare = 1e6f; // of a fixture; 1 is all of it
constexpr float kDark = 1e-9f;        // intensity; what is less is switched off

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

Fixture fixtureFrom(const JsonItem& item, std::vector<std::string>& warnings)
{
    item.warnOfUnknown(
        {"id", "centre", "normal", "area", "radiance", "power", "error", "determined", "on"},
        warnings);
    Fixture fixture;
    fixture.centre = item.vectorAt("centre");
    fixture.normal = item.facing("normal");
    fixture.area = item.size("area");
    fixture.radiance = item.lightAt("radiance");
    if (!item.flag("on", true)) fixture.radiance = glm::vec3(0.0f);
    return fixture;
}

int fixtureAt(const JsonItem& item, size_t fixtures)
{
    const json& value = *item.find("fixture");
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= fixtures)
        item.refuse(fmt::format("\"fixture\" is {}; it must be the place of one of the {} "
                                "fixtures in their list, counted from 0",
                                printable(value), fixtures),
                    "fixture");
    return value.get<int>();
}

/// What a light sends: a share of its fixture's, so that whoever edits the fixture edits it too, or
/// an intensity of its own.
void takeIntensity(const JsonItem& item, const std::vector<Fixture>& fixtures, PointLight& light)
{
    if (item.find("fixture") == nullptr) {
        if (item.find("share") != nullptr)
            item.refuse("\"share\" is that of a fixture; name it as \"fixture\"", "share");
        light.intensity = item.lightAt("intensity");
        return;
    }
    if (item.find("intensity") != nullptr)
        item.refuse("\"intensity\" is for lights without \"fixture\"; a light of a fixture "
                    "has a \"share\" of it",
                    "intensity");
    light.fixture = fixtureAt(item, fixtures.size());
    light.intensity =
        item.lightAt("share") * intensityOf(fixtures[static_cast<size_t>(light.fixture)]);
}

PointLight lightFrom(const JsonItem& item, const std::vector<Fixture>& fixtures,
                     std::vector<std::string>& warnings)
{
    item.warnOfUnknown({"type", "position", "normal", "intensity", "radius", "fixture", "share"},
                       warnings);
    if (const json* type = item.find("type"); type != nullptr && *type != "point")
        item.refuse(fmt::format("\"type\" is {}; delight knows \"point\" alone, other types are "
                                "for relight",
                                printable(*type)),
                    "type");
    PointLight light;
    light.position = item.vectorAt("position");
    light.normal = item.facing("normal");
    light.radius = item.size("radius");
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
    ordered_json document{{"format", kLightsFormat},
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
    return textOf(document);
}

Lights readLights(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    const JsonDocument document(file, kLightsFormat);
    const JsonItem top = document.top();
    top.warnOfUnknown({"format", "units", "fixtures", "lights", "ambient", "sun"}, warnings);

    Lights lights;
    top.forEachIn("fixtures", "fixture", [&](const JsonItem& item) {
        lights.fixtures.push_back(fixtureFrom(item, warnings));
    });
    top.forEachIn("lights", "light", [&](const JsonItem& item) {
        lights.points.push_back(lightFrom(item, lights.fixtures, warnings));
    });
    addLightsOfWholeFixtures(lights);
    dropDark(lights.points);
    if (top.has("ambient")) lights.ambient = top.lightAt("ambient");
    lights.sun = sunOf(top, warnings);
    if (lights.points.empty() && lights.ambient == glm::vec3(0.0f) && !lights.sun)
        malformed(top.what, "holds no light: it needs \"lights\", \"fixtures\", \"ambient\" or "
                            "\"sun\" that shine");
    return lights;
}

} // namespace relamp
