#include "scan/gltf_lights.h"

#include "base/json.h"
#include "scan/gltf_read.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

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

size_t append(json& list, const json& item)
{
    list.push_back(item);
    return list.size() - 1;
}

float strongest(const PointLight& light)
{
    return std::max({light.intensity.r, light.intensity.g, light.intensity.b});
}

json punctual(const PointLight& light, const std::string& name, float metresPerUnit)
{
    return {{"name", name},
            {"type", "point"},
            {"intensity", shortest(strongest(light) / (metresPerUnit * metresPerUnit))},
            {"color", asJson(light.intensity / strongest(light))}};
}

} // namespace

void addLights(json& document, const std::vector<PointLight>& lights,
               const glm::mat4& worldFromFile)
{
    const float metresPerUnit = glm::length(glm::vec3(worldFromFile[0]));
    const glm::mat4 fileFromWorld = glm::inverse(worldFromFile);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (strongest(lights[i]) <= 0.0f) continue;
        json& sceneNodes = nodesOfScene(document); // before there are nodes of ours
        const std::string name = fmt::format("relamp {}", i);
        const size_t light = append(document["extensions"][kExtension]["lights"],
                                    punctual(lights[i], name, metresPerUnit));
        const glm::vec3 place = fileFromWorld * glm::vec4(lights[i].position, 1.0f);
        sceneNodes.push_back(
            append(document["nodes"], {{"name", name},
                                       {"translation", asJson(place)},
                                       {"extensions", {{kExtension, {{"light", light}}}}}}));
    }
    if (!document.value("extensions", json::object()).contains(kExtension)) return;
    json& used = document["extensionsUsed"];
    if (std::find(used.begin(), used.end(), kExtension) == used.end()) used.push_back(kExtension);
}

} // namespace relamp
