#include "scan/gltf_lights.h"

#include "base/json.h"
#include "scan/gltf_read.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr const char* kExtension = "KHR_lights_punctual";

/// Nodes of the scene that was read; of a file without scenes, a new scene of all that it shows.
json& nodesOfScene(json& document)
{
    if (document.value("scenes", json::array()).empty()) {
        document["scenes"] = {{{"nodes", rootNodes(document)}}};
        document["scene"] = 0;
    }
    return document["scenes"].at(document.value("scene", size_t{0}))["nodes"];
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

json punctual(const char* type, glm::vec3 light, const std::string& name)
{
    return {{"name", name},
            {"type", type},
            {"intensity", shortest(strongest(light))},
            {"color", asJson(light / strongest(light))}};
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

/// Adds lights to a document, each with a node in its scene.
class LightAdder
{
public:
    explicit LightAdder(json& document) : document_(document) {}

    /// `node` says where it is, or where it shines from.
    void add(json light, json node)
    {
        json& sceneNodes = nodesOfScene(document_); // before there are nodes of ours
        node["name"] = light["name"];
        const size_t index = appendTo(document_["extensions"][kExtension]["lights"], light);
        node["extensions"][kExtension]["light"] = index;
        sceneNodes.push_back(appendTo(document_["nodes"], node));
    }

private:
    json& document_;
};

} // namespace

void addLights(json& document, const Lights& lights, const glm::mat4& worldFromFile)
{
    const float metresPerUnit = glm::length(glm::vec3(worldFromFile[0]));
    const glm::mat4 fileFromWorld = glm::inverse(worldFromFile);
    LightAdder adder(document);
    for (size_t i = 0; i < lights.points.size(); ++i) {
        const PointLight& point = lights.points[i];
        if (strongest(point.intensity) <= 0.0f) continue;
        const glm::vec3 place = fileFromWorld * glm::vec4(point.position, 1.0f);
        // E = I / d^2, with d in units of the file.
        adder.add(punctual("point", point.intensity / (metresPerUnit * metresPerUnit),
                           fmt::format("relamp {}", i)),
                  {{"translation", asJson(place)}});
    }
    if (lights.sun && strongest(lights.sun->irradiance) > 0.0f) {
        const glm::vec3 towards = glm::normalize(glm::mat3(fileFromWorld) * lights.sun->direction);
        adder.add(punctual("directional", lights.sun->irradiance, "relamp sun"),
                  {{"rotation", rotationTo(towards)}}); // it shines along -z
    }
    if (!document.value("extensions", json::object()).contains(kExtension)) return;
    json& used = document["extensionsUsed"];
    if (std::find(used.begin(), used.end(), kExtension) == used.end()) used.push_back(kExtension);
}

} // namespace relamp
