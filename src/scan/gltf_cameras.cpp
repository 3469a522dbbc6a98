#include "scan/gltf_cameras.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <tiny_gltf.h>

namespace relamp
{

std::optional<ScanCamera> cameraAt(const tinygltf::Model& model, const tinygltf::Node& node,
                                   const glm::mat4& worldFromNode)
{
    if (node.camera < 0 || static_cast<size_t>(node.camera) >= model.cameras.size()) return {};
    const tinygltf::Camera& camera = model.cameras[static_cast<size_t>(node.camera)];
    const auto angle = static_cast<float>(camera.perspective.yfov);
    if (camera.type != "perspective" || !(angle > 0.0f && angle < glm::pi<float>())) return {};

    // glTF 2.0, 3.10.1: a camera looks along its -z, +y is up; a scale of its node says nothing.
    const glm::vec3 forward = -glm::vec3(worldFromNode[2]);
    const glm::vec3 up(worldFromNode[1]);
    const glm::vec3 position(worldFromNode[3]);
    const float sum = position.x + position.y + position.z;
    const float area = glm::length(glm::cross(forward, up)); // 0, or no number: not a view
    if (!std::isfinite(sum) || !std::isfinite(area) || !(area > 0.0f)) return {};
    return ScanCamera{.index = node.camera,
                      .name = camera.name,
                      .camera = {.position = position,
                                 .forward = glm::normalize(forward),
                                 .up = glm::normalize(up),
                                 .fieldOfView = angle,
                                 .across = Across::height}};
}

} // namespace relamp
