#pragma once

#include "relamp/scan.h"

#include <string>
#include <vector>

namespace relamp
{

/// Makes what an importer read into what Mesh promises.
///
/// An index that is out of range, or a number that means nothing (check_numbers.h), is an
/// Error(malformed); triangles without area go, counted in `warnings`. Normals come from
/// `vertexNormals` (one a position) where the file has them, else from the faces around a vertex,
/// smoothed except over edges sharper than 45 degrees; positions that coincide count as one, so
/// that a UV seam leaves no crease. Where half of a surface leans from what lies around it, it is a
/// reconstruction: its faces, evened out (even_normals.h), know better than the file. Vertices of a
/// textured mesh that no triangle uses go too: some files share one list among all meshes. `file`
/// names the file in errors.
void finishMesh(Mesh& mesh, std::vector<glm::vec3> vertexNormals, const std::string& file,
                std::vector<std::string>& warnings);

} // namespace relamp
