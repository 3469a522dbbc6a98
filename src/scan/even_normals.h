#pragma once

#include "scan/vertex_fans.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Triangles without their noise: unit normals, one a triangle, from such.
///
/// A reconstruction's triangles lean by some degrees to all sides, and where light grazes a wall,
/// one gets half as much again as the next. Normals are averaged over the triangles around, and
/// around those, that face about the same way once the worst is averaged away; so a corner stays,
/// and a curved surface as curved as it is. `area` is of triangles, in m^2.
std::vector<glm::vec3> evenNormals(std::span<const glm::vec3> normals, std::span<const float> area,
                                   const VertexFans& fans);

} // namespace relamp
