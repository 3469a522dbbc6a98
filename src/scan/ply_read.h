#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <span>

namespace relamp
{

/// Whether these are the bytes of a PLY file.
bool isPly(std::span<const std::byte> bytes);

/// Reads a PLY mesh: vertex colours, texture coordinates a vertex (u v, s t, texture_u texture_v)
/// or a face's corner (texcoord, texnumber), pictures named by "comment TextureFile".
///
/// Not through Assimp: its 5.2 loops forever on a cut-off header, and puts the coordinates of faces
/// on their vertices, which tears every seam. `bytes` is the content of `file`.
Scan readPly(std::span<const std::byte> bytes, const std::filesystem::path& file,
             const ScanOptions& options, Progress& progress);

} // namespace relamp
