#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// A glTF file made plain: one document and one buffer that it refers to, nothing outside, nothing
/// compressed.
struct PlainGltf
{
    nlohmann::json document;
    std::vector<uint8_t> binary;
    std::vector<std::string> warnings; // what could not be taken along, a sentence each
};

/// Makes `bytes` of `file`, a .gltf or .glb, plain.
///
/// Embedded, data-URI and external buffers and images come into the one binary buffer;
/// EXT_meshopt_compression and KHR_draco_mesh_compression are decoded and dropped from the
/// extension lists. Every buffer view of the result lies within the buffer. External files are
/// looked for beside `file`, and nowhere else unless `options` allow it. The document has passed
/// checkShape. Throws Error(cannotRead | malformed | unsupported).
PlainGltf unpackGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
                     const ScanOptions& options);

} // namespace relamp
