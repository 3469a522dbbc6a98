#include "scan/gltf_lights.h"

#include "base/json.h"
#include "scan/gltf_read.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr const char* kExtension = "KHR_lights_punctual";

/// A scene of the document, and what a candela is in the programs that show it.
struct Audience
{
    float white;        // cd/m^2 of what they show as white at their own exposure
    const char* suffix; // of their lights' names
};

// three.js (since r155), and viewers built on it, show radiance = candela / m^2 as it is: 1 cd/m^2
// is white, as it is of emissive textures.
constexpr Audience kViewers{1.0f, ""};

// Blender imports the nodes of all scenes, divides candela and lux by the lumens of a watt
// (io_scene_gltf2, PBR_WATTS_TO_LUMENS) and shows 1 W/(m^2 sr) as white. To what is meant for it
// the viewers' lights add a seven hundredth.
constexpr Audience kBlender{683.0f, " for Blender"};

/// A light, and the node that says where it is or where it shines from.
struct PlacedLight
{
    std::string type;
    std::string name;
    glm::vec3 light{0.0f}; // RGB, radiance in place of cd/m^2
    json node;
};

/// Index of the scene that was read; of a file without scenes, a new one of all that it shows.
size_t shownScene(json& document)
{
    if (document.value("scenes", json::array()).empty()) {
        document["scenes"] = {{{"nodes", rootNodes(document)}}};
        document["scene"] = 0;
    }
    return document.value("scene", size_t{0});
}

json asJson(const glm::vec3& v)
{
    return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

size_t appendTo(json& list, const json& item)
{
    list.push_back(item);
    return list.size() - 1;
}

float strongest(glm::vec3 light)
{
    return std::max({light.r, light.g, light.b});
}

/// The turn that brings the z axis to a unit direction, as glTF has it: x, y, z, w.
json rotationTo(glm::vec3 direction)
{
    constexpr glm::vec3 kBehind(0.0f, 0.0f, 1.0f);
    const glm::vec3 axis = glm::cross(kBehind, direction);
    const glm::vec4 turn(axis, 1.0f + direction.z);
    if (glm::length(turn) < 1e-3f) return {1.0, 0.0, 0.0, 0.0}; // half a turn around x
    const glm::vec4 unit = glm::normalize(turn);
    return {shortest(unit.x), shortest(unit.y), shortest(unit.z), shortest(unit.w)};
}

/// That of its fixture; where several points stand for one, with a number behind.
std::vector<std::string> namesOfPoints(const Lights& lights)
{
    std::map<int, int> all;
    for (const PointLight& point : lights.points) ++all[point.fixture];
    std::map<int, int> used;
    std::vector<std::string> names;
    for (const PointLight& point : lights.points) {
        const int before = used[point.fixture]++;
        std::string name =
            point.fixture < 0 ? "light" : lights.nameOf(static_cast<size_t>(point.fixture));
        if (all[point.fixture] > 1) name += fmt::format(", part {}", before + 1);
        names.push_back(std::move(name));
    }
    return names;
}

/// A point that stands for a surface that faces one way shines to that side alone, like a matte
/// one. A spot of 180 degrees that fades from its axis goes as 3 cos^2 - 2 cos^3 in three.js, which
/// has the flux pi of a cosine; Cycles takes that times another cosine, and so 0.7 of the flux. One
/// that shines all around is a point.
PlacedLight placed(const PointLight& point, std::string name, const glm::mat4& fileFromWorld,
                   float metresPerUnit)
{
    PlacedLight light{
        "point",
        std::move(name),
        // E = I / d^2, with d in units of the file.
        point.intensity / (metresPerUnit * metresPerUnit),
        {{"translation", asJson(glm::vec3(fileFromWorld * glm::vec4(point.position, 1.0f)))}}};
    if (point.normal == glm::vec3(0.0f)) return light;
    const glm::vec3 towards = glm::normalize(glm::mat3(fileFromWorld) * point.normal);
    light.type = "spot";
    light.light *= 4.0f;                           // 4 pi I all around, pi I to one side
    light.node["rotation"] = rotationTo(-towards); // it shines along -z
    return light;
}

std::vector<PlacedLight> placedLights(const Lights& lights, const glm::mat4& worldFromFile)
{
    const float metresPerUnit = glm::length(glm::vec3(worldFromFile[0]));
    const glm::mat4 fileFromWorld = glm::inverse(worldFromFile);
    const std::vector<std::string> names = namesOfPoints(lights);
    std::vector<PlacedLight> all;
    for (size_t i = 0; i < lights.points.size(); ++i)
        all.push_back(placed(lights.points[i], names[i], fileFromWorld, metresPerUnit));
    if (lights.sun) {
        const glm::vec3 towards = glm::normalize(glm::mat3(fileFromWorld) * lights.sun->direction);
        all.push_back({"directional",
                       "sun",
                       lights.sun->irradiance,
                       {{"rotation", rotationTo(towards)}}}); // it shines along -z
    }
    std::erase_if(all, [](const PlacedLight& one) { return strongest(one.light) <= 0.0f; });
    return all;
}

json punctual(const PlacedLight& one, const Audience& audience)
{
    json light{{"name", one.name + audience.suffix},
               {"type", one.type},
               {"intensity", shortest(audience.white * strongest(one.light))},
               {"color", asJson(one.light / strongest(one.light))}};
    if (one.type == "spot")
        light["spot"] = {{"innerConeAngle", 0.0}, {"outerConeAngle", glm::half_pi<double>()}};
    return light;
}

/// Puts lights into a scene, and says there what its candela are of.
void lightScene(json& document, size_t scene, const std::vector<PlacedLight>& lights,
                const Audience& audience)
{
    for (const PlacedLight& one : lights) {
        json node = one.node;
        const json light = punctual(one, audience);
        node["name"] = light["name"];
        node["extensions"][kExtension]["light"] =
            appendTo(document["extensions"][kExtension]["lights"], light);
        document["scenes"][scene]["nodes"].push_back(appendTo(document["nodes"], node));
    }
    json& extras = document["scenes"][scene]["extras"];
    if (!extras.is_object()) extras = json::object();
    extras["relamp"] = {{"whiteNits", audience.white}};
}

} // namespace

void addLights(json& document, const Lights& lights, const glm::mat4& worldFromFile)
{
    const std::vector<PlacedLight> all = placedLights(lights, worldFromFile);
    if (all.empty()) return;
    const size_t shown = shownScene(document);
    const json room = document["scenes"][shown]["nodes"];
    lightScene(document, shown, all, kViewers);
    const size_t ofBlender =
        appendTo(document["scenes"], {{"name", "relamp for Blender"}, {"nodes", room}});
    lightScene(document, ofBlender, all, kBlender);
    json& used = document["extensionsUsed"];
    if (std::find(used.begin(), used.end(), kExtension) == used.end()) used.push_back(kExtension);
}

} // namespace relamp
