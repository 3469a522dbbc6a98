#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <span>

#include <tiny_gltf.h>

namespace relamp
{

/// What is needed to write a glTF scan back as it came: the plain model, and where its parts went.
struct GltfSource
{
    struct MeshOrigin
    {
        int mesh;
        int primitive;
    };

    tinygltf::Model model;
    std::vector<MeshOrigin> originOfMesh; // of Scan::meshes
    std::vector<int> imageOfPage;         // of Scan::pages; -1 for a page of vertices
};

/// Reads a .gltf or .glb. `bytes` is the content of `file`.
Scan readGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
              const ScanOptions& options, Progress& progress);

} // namespace relamp
