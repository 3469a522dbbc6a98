#include "relamp/lights.h"

#include "base/fail.h"
#include "base/json.h"
#include "base/radiometry.shared.h"
#include "lights/camera_item.h"
#include "lights/fixture_named.h"
#include "lights/json_document.h"
#include "lights/lights_from.h"
#include "lights/point_light.h"
#include "lights/sun_item.h"

#include <algorithm>
#include <array>
#include <map>
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

ordered_json toJson(const Fixture& fixture, int id)
{
    ordered_json object{{"id", id}};
    if (!fixture.name.empty()) object["name"] = fixture.name;
    object["centre"] = toJson(fixture.centre);
    object["normal"] = facingAsJson(fixture.normal);
    object["area"] = shortest(fixture.area);
    if (fixture.unseen > 0.0f) object["unseen"] = shortest(fixture.unseen);
    object["radiance"] = toJson(fixture.radiance);
    object["power"] = toJson(fixture.power());
    object["on"] = true;
    if (fixture.error != glm::vec3(0.0f)) object["error"] = toJson(fixture.error);
    if (!fixture.determined) object["determined"] = false;
    if (fixture.group >= 0) object["group"] = fixture.group;
    return object;
}

/// What part of its fixture's light a point sends, by channel; none for a light of its own.
std::optional<glm::vec3> shareOf(const PointLight& light, const Lights& lights)
{
    if (light.fixture < 0) return {};
    const glm::vec3 whole = intensityOf(lights.fixtures[static_cast<size_t>(light.fixture)]);
    glm::vec3 share(0.0f);
    for (int c = 0; c < 3; ++c) {
        if (light.intensity[c] == 0.0f) continue;
        share[c] = light.intensity[c] / whole[c];
        if (!(share[c] <= kLargestShare)) return {}; // the fixture itself does not shine so
    }
    return share;
}

ordered_json toJson(const PointLight& light, const Lights& lights)
{
    ordered_json object{{"type", "point"},
                        {"position", toJson(light.position)},
                        {"normal", facingAsJson(light.normal)},
                        {"radius", shortest(light.radius)}};
    if (const auto share = shareOf(light, lights)) {
        object["fixture"] = lights.idOf(static_cast<size_t>(light.fixture));
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
    item.warnOfUnknown({"id", "name", "centre", "normal", "area", "unseen", "radiance", "power",
                        "error", "determined", "group", "on"},
                       warnings);
    Fixture fixture;
    if (item.has("id")) fixture.id = fixtureIdAt(item, "id");
    if (item.has("group")) fixture.group = fixtureIdAt(item, "group");
    fixture.name = item.text("name", "");
    fixture.centre = item.vectorAt("centre");
    fixture.normal = item.facing("normal");
    fixture.area = item.size("area");
    fixture.unseen = item.size("unseen");
    fixture.radiance = item.lightAt("radiance");
    if (!item.flag("on", true)) fixture.radiance = glm::vec3(0.0f);
    return fixture;
}

Tempering temperingOf(const JsonItem& top, std::vector<std::string>& warnings)
{
    const std::optional<JsonItem> item = top.objectIn("tempering");
    if (!item) return {};
    item->warnOfUnknown({"power", "kept", "scale"}, warnings);
    Tempering tempering{.kept = item->lightAt("kept"),
                        .power = static_cast<float>(item->numberAt("power", 0.0, 1.0))};
    if (item->has("scale")) tempering.scale = item->lightAt("scale");
    const auto leastOf = [](glm::vec3 rgb) { return std::min({rgb.r, rgb.g, rgb.b}); };
    if (leastOf(tempering.kept) <= 0.0f) item->refuse("\"kept\" must be above 0", "kept");
    if (leastOf(tempering.scale) < kFaintest)
        item->refuse(fmt::format("\"scale\" must be {} at least", kFaintest), "scale");
    return tempering;
}

/// One that was copied by hand has the number and the name of its model, and loses them.
void dropCopiedNumbers(std::vector<Fixture>& fixtures, const std::string& file,
                       std::vector<std::string>& warnings)
{
    std::map<int, size_t> placeOf;
    for (size_t i = 0; i < fixtures.size(); ++i) {
        Fixture& fixture = fixtures[i];
        if (fixture.id < 0 || placeOf.try_emplace(fixture.id, i).second) continue;
        warnings.push_back(fmt::format("{}: fixture {} of the list has the id {} of another and "
                                       "gets a new one; give it one of its own",
                                       file, i, fixture.id));
        fixture.id = -1;
        fixture.name.clear();
    }
}

/// The first number behind all that fixtures have.
int numberBehind(const std::vector<Fixture>& fixtures)
{
    int next = 0;
    for (const Fixture& fixture : fixtures) next = std::max(next, fixture.id + 1);
    return next;
}

int fixtureAt(const JsonItem& item, const Lights& lights)
{
    const size_t place = lights.placeOf(fixtureIdAt(item, "fixture"));
    if (place == lights.fixtures.size())
        item.refuse(fmt::format("\"fixture\" is {}; it must be the id of one of the fixtures: {}",
                                printable(*item.find("fixture")), namesOf(lights)),
                    "fixture");
    return static_cast<int>(place);
}

/// What a light sends: a share of its fixture's, so that whoever edits the fixture edits it too, or
/// an intensity of its own.
void takeIntensity(const JsonItem& item, const Lights& lights, PointLight& light)
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
    light.fixture = fixtureAt(item, lights);
    light.intensity =
        item.lightAt("share") * intensityOf(lights.fixtures[static_cast<size_t>(light.fixture)]);
}

PointLight lightFrom(const JsonItem& item, const Lights& lights, std::vector<std::string>& warnings)
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
    takeIntensity(item, lights, light);
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

int Lights::idOf(size_t place) const
{
    if (fixtures[place].id >= 0) return fixtures[place].id;
    const auto end = fixtures.begin() + static_cast<std::ptrdiff_t>(place);
    const auto before =
        std::count_if(fixtures.begin(), end, [](const Fixture& fixture) { return fixture.id < 0; });
    return numberBehind(fixtures) + static_cast<int>(before);
}

std::string Lights::nameOf(size_t place) const
{
    const std::string& name = fixtures[place].name;
    return name.empty() ? fmt::format("fixture {}", idOf(place)) : name;
}

size_t Lights::placeOf(int id) const
{
    int next = numberBehind(fixtures); // of the first without one
    size_t place = 0;
    for (; place < fixtures.size(); ++place)
        if ((fixtures[place].id >= 0 ? fixtures[place].id : next++) == id) break;
    return place;
}

std::string lightsAsJson(const Lights& lights)
{
    ordered_json document{{"format", kLightsFormat},
                          {"units",
                           "metres, Y up; radiance 1 = the texture's white; intensity in radiance "
                           "m^2, power in radiance m^2 sr; linear Rec. 709"}};
    document["fixtures"] = ordered_json::array();
    for (size_t i = 0; i < lights.fixtures.size(); ++i)
        document["fixtures"].push_back(toJson(lights.fixtures[i], lights.idOf(i)));
    document["lights"] = ordered_json::array();
    for (const PointLight& light : lights.points)
        document["lights"].push_back(toJson(light, lights));
    document["ambient"] = toJson(lights.ambient);
    for (const glm::vec3 times : lights.openings)
        document["openings"].push_back({{"timesAmbient", toJson(times)}});
    if (lights.sun) document["sun"] = toJson(*lights.sun);
    if (!lights.camera.isNeutral()) document["camera"] = cameraAsJson(lights.camera);
    if (lights.tempering != Tempering{})
        document["tempering"] = {{"power", shortest(lights.tempering.power)},
                                 {"kept", toJson(lights.tempering.kept)}};
    if (lights.tempering.scale != glm::vec3(1.0f))
        document["tempering"]["scale"] = toJson(lights.tempering.scale);
    if (lights.gaps > 0.0f) document["gaps"] = shortest(lights.gaps);
    return textOf(document);
}

Lights readLights(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    return lightsFrom(JsonDocument(file, kLightsFormat), warnings);
}

Lights lightsFrom(const JsonDocument& document, std::vector<std::string>& warnings)
{
    const JsonItem top = document.top();
    top.warnOfUnknown({"format", "units", "fixtures", "lights", "ambient", "openings", "sun",
                       "camera", "tempering", "gaps"},
                      warnings);

    Lights lights;
    top.forEachIn("fixtures", "fixture", [&](const JsonItem& item) {
        lights.fixtures.push_back(fixtureFrom(item, warnings));
    });
    dropCopiedNumbers(lights.fixtures, top.what, warnings);
    top.forEachIn("lights", "light", [&](const JsonItem& item) {
        lights.points.push_back(lightFrom(item, lights, warnings));
    });
    addLightsOfWholeFixtures(lights);
    dropDark(lights.points);
    if (top.has("ambient")) lights.ambient = top.lightAt("ambient");
    top.forEachIn("openings", "opening", [&](const JsonItem& item) {
        item.warnOfUnknown({"timesAmbient"}, warnings);
        lights.openings.push_back(item.lightAt("timesAmbient"));
    });
    lights.sun = sunOf(top, warnings);
    if (const auto camera = top.objectIn("camera")) lights.camera = cameraOf(*camera, warnings);
    lights.tempering = temperingOf(top, warnings);
    if (top.has("gaps")) lights.gaps = static_cast<float>(top.numberAt("gaps", 0.0, 1.0));
    if (lights.points.empty() && lights.ambient == glm::vec3(0.0f) && !lights.sun)
        malformed(top.what, "holds no light: it needs \"lights\", \"fixtures\", \"ambient\" or "
                            "\"sun\" that shine");
    return lights;
}

} // namespace relamp
