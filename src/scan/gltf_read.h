#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// What is needed to write a glTF scan back as it came: its plain content, and where its parts
/// went.
///
/// The JSON is kept rather than tinygltf's model of it: what relamp does not know of must survive,
/// and tinygltf writes less than it has read (names of samplers, extensions of accessors, empty
/// nodes).
struct GltfSource
{
    struct MeshOrigin
    {
        int node;
        int mesh;
        int primitive;
    };

    nlohmann::json document;     // checked by checkShape; nothing compressed or outside of `binary`
    std::vector<uint8_t> binary; // its one buffer; every buffer view lies within
    std::vector<int> imageOfTexture;      // as relamp reads it; -1 for none
    std::vector<MeshOrigin> originOfMesh; // of Scan::meshes
    std::vector<int> imageOfPage;         // of Scan::pages; -1 for a page of vertices
};

/// The nodes that are nobody's children: what a file without scenes shows.
std::vector<int> rootNodes(const nlohmann::json& document);

/// Reads a .gltf or .glb. `bytes` is the content of `file`.
Scan readGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
              const ScanOptions& options, Progress& progress);

} // namespace relamp
