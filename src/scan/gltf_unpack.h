#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// A glTF file made plain: one JSON text and one buffer that it refers to, nothing outside, nothing
/// compressed.
struct PlainGltf
{
    std::string glb;                   // GLB container with the plain content
    std::vector<std::string> warnings; // what could not be taken along, a sentence each
};

/// Turns `bytes` of `file`, a .gltf or .glb, into a plain GLB.
///
/// Embedded, data-URI and external buffers and images come into the one binary chunk;
/// EXT_meshopt_compression and KHR_draco_mesh_compression are decoded and dropped from the extension
/// lists. Every buffer view of the result lies within the chunk. External files are looked for
/// beside `file`. Throws Error(cannotRead | malformed | unsupported).
PlainGltf unpackGltf(std::span<const std::byte> bytes, const std::filesystem::path& file);

} // namespace relamp
