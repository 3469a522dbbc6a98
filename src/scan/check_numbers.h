#pragma once

#include "relamp/scan.h"

#include <string>
#include <vector>

namespace relamp
{

/// The one check of the numbers of a mesh, whatever format it comes from.
///
/// Positions are finite and within 100 km, texture coordinates within 1000 pictures, colours
/// between nothing and the largest half float, normals (one a position, or none) of a length that
/// a float can hold. Others, where a triangle uses them, are counted and refused, Error(malformed)
/// that begins with `file`; those that no triangle uses are set to zero. Every index is in range.
void checkNumbers(Mesh& mesh, std::vector<glm::vec3>& vertexNormals, const std::string& file);

} // namespace relamp
