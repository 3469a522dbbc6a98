#include "relight/relighting_file.h"
#include "base/fail.h"
#include "base/radiometry.shared.h"
#include "lights/fixture_named.h"
#include "lights/fixture_place.h"
#include "lights/json_document.h"
#include "lights/sun_item.h"
#include "relamp/names.h"
#include "relamp/relight.h"
#include "relight/light_emission.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr float kPerDegree = kPi / 180.0f;

/// A lights file being read.
class LightsReader
{
public:
    LightsReader(std::filesystem::path folder, const Lights& captured, NamedFiles& files,
                 std::vector<std::string>& warnings)
        : folder_(std::move(folder)), captured_(captured), files_(files), warnings_(warnings)
    {}

    Relighting read(const JsonItem& top);

private:
    void readWhite(const JsonItem& top);
    void readSky(const JsonItem& top);
    void readFixtures(const JsonItem& top);
    void readFixture(const JsonItem& item);
    [[nodiscard]] size_t placeMeant(const JsonItem& item) const;
    [[nodiscard]] LitFixture describedBy(const JsonItem& item);
    void readLight(const JsonItem& item);
    void readShape(const JsonItem& item, NewLight& light) const;
    const IesPhotometry& photometryAt(const std::filesystem::path& file);
    [[nodiscard]] std::filesystem::path besideFile(const JsonItem& item, const char* key) const;

    std::filesystem::path folder_; // in which the files lie that are named
    const Lights& captured_;
    NamedFiles& files_;
    std::vector<std::string>& warnings_;
    PhotometricWhite white_;
    Relighting lighting_;
    size_t knownByPlace_ = 0; // fixtures without a number
};

LightType typeOf(const JsonItem& item)
{
    const std::string name = item.text("type", nameOf(LightType::point));
    if (const auto type = named<LightType>(name)) return *type;
    item.refuse(fmt::format("\"type\" is {}; it must be one of {}", printable(json(name)),
                            namesInWords<LightType>()),
                "type");
}

/// For people and for the viewer, which shows it.
void checkName(const JsonItem& item)
{
    static_cast<void>(item.text("name", ""));
}

/// Numbers that are fine each may multiply to what no float holds.
void checkBrightness(const JsonItem& item, glm::vec3 emission)
{
    constexpr float kBrightest = 1e18f; // its square is still a float
    if (!(std::max({emission.r, emission.g, emission.b}) <= kBrightest))
        item.refuse("is brighter than can be computed; look at its numbers and at \"white\"");
}

float positive(const JsonItem& item, const char* key)
{
    const float value = item.numberAt(key);
    if (!(value > 0.0f)) item.refuse(fmt::format("\"{}\" must be greater than 0", key), key);
    return value;
}

float degrees(const JsonItem& item, const char* key, float otherwise, float most)
{
    if (!item.has(key)) return otherwise;
    const float value = item.size(key);
    if (value > most)
        item.refuse(fmt::format("\"{}\" must lie between 0 and {} degrees", key, most), key);
    return value * kPerDegree;
}

glm::vec3 directionOf(const JsonItem& item)
{
    const glm::vec3 direction = item.vectorAt("direction");
    if (glm::length(direction) < 1e-6f) item.refuse("\"direction\" has no length", "direction");
    return glm::normalize(direction);
}

glm::vec2 sizeOf(const JsonItem& item)
{
    const glm::vec2 size = item.pairAt("size"); // width and height
    if (!(size.x > 0.0f) || !(size.y > 0.0f) || size.x > 1e4f || size.y > 1e4f)
        item.refuse("\"size\" must be greater than 0 and no more than 10000 m", "size");
    return size;
}

void LightsReader::readShape(const JsonItem& item, NewLight& light) const
{
    if (light.type != LightType::sun) light.position = item.vectorAt("position");
    const bool isAimed = light.type != LightType::point && light.type != LightType::sphere;
    if (isAimed || item.has("direction")) light.direction = directionOf(item);
    if (item.has("along")) light.along = item.vectorAt("along");
    const bool isRound = light.type == LightType::disc || light.type == LightType::sphere;
    light.radius = isRound ? positive(item, "radius") : item.size("radius");
    if (light.type == LightType::rectangle) light.size = sizeOf(item);
    if (light.type == LightType::spot)
        light.cone = 0.5f * degrees(item, "cone", 0.5f * kPi, 360.0f);
    light.blend = item.size("blend", light.blend);
    if (light.blend > 1.0f) item.refuse("\"blend\" must lie between 0 and 1", "blend");
    light.angle = degrees(item, "angle", light.angle, 90.0f);
}

std::filesystem::path LightsReader::besideFile(const JsonItem& item, const char* key) const
{
    return folder_ / item.text(key, "");
}

void LightsReader::readLight(const JsonItem& item)
{
    // What delight writes of a fixture: the fixture itself is what shines.
    if (item.has("fixture")) return;
    item.warnOfUnknown({"type",     "position",   "direction", "normal", "along",   "size",
                        "radius",   "cone",       "blend",     "angle",  "ies",     "intensity",
                        "radiance", "irradiance", "lumens",    "watts",  "candela", "nits",
                        "lux",      "kelvin",     "colour",    "on",     "dim",     "name"},
                       warnings_);
    checkName(item);
    NewLight light;
    light.type = typeOf(item);
    readShape(item, light);
    if (item.has("ies")) {
        if (light.type != LightType::point && light.type != LightType::spot)
            item.refuse("\"ies\" is for a point or spot", "ies");
        const IesPhotometry& lamp = photometryAt(besideFile(item, "ies"));
        light.profile = lamp.profile;
        const EmissionWish wish = emissionWishOf(item);
        light.emission = radiometric(wish.lumens ? *wish.lumens / lamp.lumens : 1.0f,
                                     wish.colourOr(glm::vec3(1.0f), white_), white_);
    } else {
        light.emission = emissionOf(item, light, white_);
    }
    light.emission *= item.flag("on", true) ? item.size("dim", 1.0f) : 0.0f;
    checkBrightness(item, light.emission);
    lighting_.lights.push_back(std::move(light));
}

const IesPhotometry& LightsReader::photometryAt(const std::filesystem::path& file)
{
    const auto known = files_.ies.find(file);
    return known != files_.ies.end() ? known->second
                                     : files_.ies.emplace(file, readIes(file)).first->second;
}

/// The place of the room's fixture that an item names by its number or its name.
size_t LightsReader::placeMeant(const JsonItem& item) const
{
    const char* key = item.has("id") ? "id" : "name";
    if (!item.has(key))
        item.refuse("needs an \"id\" or \"name\" of the room's fixtures, or a \"centre\"");
    const size_t place = item.has("id") ? captured_.placeOf(fixtureIdAt(item, "id"))
                                        : placeOfNamed(captured_, item.text("name", ""));
    if (place == captured_.fixtures.size())
        item.refuse(fmt::format("\"{}\" is {}; the room's fixtures are: {}", key,
                                printable(*item.find(key)), namesOf(captured_)),
                    key);
    return place;
}

/// A fixture that is described in full. One without a number is known by its place, as in a file of
/// relamp 0.1; one that was moved is none of the room's.
LitFixture LightsReader::describedBy(const JsonItem& item)
{
    LitFixture lit;
    Fixture& fixture = lit.fixture;
    fixture.centre = item.vectorAt("centre");
    fixture.normal = item.facing("normal");
    fixture.area = item.size("area");
    fixture.unseen = item.size("unseen");
    fixture.radiance = item.lightAt("radiance");
    std::vector<PieceOfSurface> pieces;
    for (const Fixture& captured : captured_.fixtures) pieces.push_back(pieceOf(captured));
    const bool hasNumber = item.has("id");
    const size_t place =
        hasNumber ? captured_.placeOf(fixtureIdAt(item, "id")) : pieceAt(fixture, pieces);
    if (!hasNumber) ++knownByPlace_;
    if (place == pieces.size()) return lit;
    if (isMoved(fixture, pieces[place]))
        warnings_.push_back(fmt::format("{}: was moved away from {} and shines as a disc or ball "
                                        "where it is now",
                                        item.what, captured_.nameOf(place)));
    else
        fixture.id = captured_.idOf(place);
    return lit;
}

void LightsReader::readFixture(const JsonItem& item)
{
    item.warnOfUnknown({"id", "centre", "normal", "area", "unseen", "radiance", "power", "error",
                        "determined", "group", "on", "dim", "lumens", "watts", "kelvin", "colour",
                        "window", "name"},
                       warnings_);
    checkName(item);
    LitFixture lit;
    if (item.has("centre")) {
        lit = describedBy(item);
    } else {
        const size_t place = placeMeant(item);
        lit.fixture = captured_.fixtures[place];
        lit.fixture.id = captured_.idOf(place);
        if (item.has("radiance")) lit.fixture.radiance = item.lightAt("radiance");
    }
    lit.isWindow = item.flag("window", false);
    const EmissionWish wish = emissionWishOf(item);
    if (wish.lumens || wish.kelvin || wish.colour)
        lit.fixture.radiance = radianceUnder(wish, lit.fixture, white_);
    lit.fixture.radiance *= item.flag("on", true) ? item.size("dim", 1.0f) : 0.0f;
    checkBrightness(item, lit.fixture.radiance);
    if (const size_t place = captured_.placeOf(lit.fixture.id); place < captured_.fixtures.size())
        lighting_.fixtures[place] = lit;
    else
        lighting_.fixtures.push_back(lit);
}

/// "off" or "on" for all of them, or a list.
void LightsReader::readFixtures(const JsonItem& top)
{
    const json* fixtures = top.find("fixtures");
    if (fixtures != nullptr && fixtures->is_string()) {
        const std::string word = top.text("fixtures", "");
        if (word == "on")
            for (size_t i = 0; i < captured_.fixtures.size(); ++i)
                lighting_.fixtures[i].fixture.radiance = captured_.fixtures[i].radiance;
        else if (!word.starts_with("off"))
            top.refuse("\"fixtures\" must be \"on\", \"off\" or a list", "fixtures");
        return;
    }
    top.forEachIn("fixtures", "fixture", [&](const JsonItem& item) { readFixture(item); });
    if (knownByPlace_ > 0)
        warnings_.push_back(fmt::format("{}: {} of its fixtures have no \"id\" (relamp 0.1 wrote "
                                        "none) and are known by their places",
                                        top.what, knownByPlace_));
}

void LightsReader::readSky(const JsonItem& top)
{
    if (top.has("ambient")) lighting_.sky.radiance = top.lightAt("ambient");
    if (const auto sun = sunOf(top, warnings_)) // as delight writes it: where it stands
        lighting_.lights.push_back(asNewLight(*sun));
    const std::optional<JsonItem> found = top.objectIn("sky");
    if (!found) return;
    const JsonItem& item = *found;
    item.warnOfUnknown({"radiance", "nits", "kelvin", "colour", "environment", "turn"}, warnings_);
    Sky& sky = lighting_.sky;
    const EmissionWish wish = emissionWishOf(item);
    if (item.has("nits"))
        sky.radiance =
            radiometric(item.size("nits"), wish.colourOr(glm::vec3(1.0f), white_), white_);
    else
        sky.radiance = item.has("radiance") ? item.lightAt("radiance") : glm::vec3(1.0f);
    checkBrightness(item, sky.radiance);
    sky.turn = degrees(item, "turn", 0.0f, 360.0f);
    if (!item.has("environment")) return;
    const std::filesystem::path file = besideFile(item, "environment");
    std::shared_ptr<const Image>& image = files_.environments[file];
    if (!image) image = std::make_shared<const Image>(readImage(file));
    sky.environment = image;
}

void LightsReader::readWhite(const JsonItem& top)
{
    const std::optional<JsonItem> found = top.objectIn("white");
    if (!found) return;
    const JsonItem& item = *found;
    item.warnOfUnknown({"nits", "kelvin"}, warnings_);
    if (item.has("nits")) white_.luminance = positive(item, "nits");
    if (const EmissionWish wish = emissionWishOf(item); wish.kelvin) white_.kelvin = *wish.kelvin;
}

Relighting LightsReader::read(const JsonItem& top)
{
    // What delight says of the camera and of how far it believes its shading is not about new
    // light.
    top.warnOfUnknown({"format", "units", "fixtures", "lights", "ambient", "openings", "sun", "sky",
                       "white", "camera", "tempering", "gaps"},
                      warnings_);
    lighting_ = darkened(captured_);
    readWhite(top);
    readFixtures(top);
    top.forEachIn("lights", "light", [&](const JsonItem& item) { readLight(item); });
    readSky(top);
    return std::move(lighting_);
}

} // namespace

Relighting relightingFrom(const JsonItem& top, const std::filesystem::path& folder,
                          const Lights& captured, NamedFiles& files,
                          std::vector<std::string>& warnings)
{
    return LightsReader(folder, captured, files, warnings).read(top);
}

Relighting readRelighting(const std::filesystem::path& file, const Lights& captured,
                          std::vector<std::string>& warnings)
{
    const JsonDocument document(file, kLightsFormat);
    NamedFiles files;
    return relightingFrom(document.top(), file.parent_path(), captured, files, warnings);
}

struct RelightingReader::State
{
    NamedFiles files;
};

RelightingReader::RelightingReader() : state_(std::make_unique<State>()) {}
RelightingReader::~RelightingReader() = default;
RelightingReader::RelightingReader(RelightingReader&&) noexcept = default;
RelightingReader& RelightingReader::operator=(RelightingReader&&) noexcept = default;

Relighting RelightingReader::read(const std::string& text, const std::filesystem::path& file,
                                  const Lights& captured, std::vector<std::string>& warnings)
{
    const JsonDocument document(file.string(), text, kLightsFormat);
    return relightingFrom(document.top(), file.parent_path(), captured, state_->files, warnings);
}

} // namespace relamp
