#pragma once

#include "relamp/scan.h"

#include <optional>

#include <glm/mat4x4.hpp>

namespace tinygltf
{
class Model;
class Node;
} // namespace tinygltf

namespace relamp
{

/// The camera that a node puts into the room; none where it has none, or one without perspective or
/// with numbers that are no view.
std::optional<ScanCamera> cameraAt(const tinygltf::Model& model, const tinygltf::Node& node,
                                   const glm::mat4& worldFromNode);

} // namespace relamp
