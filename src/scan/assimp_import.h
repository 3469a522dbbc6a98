#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// What Assimp makes of a file, as plain values.
struct Import
{
    struct Material
    {
        std::string name;
        std::string texture; // of its colour; empty for none
        Wrap wrapU = Wrap::repeat;
        Wrap wrapV = Wrap::repeat;
        glm::vec3 diffuse{1.0f};
    };
    struct Mesh
    {
        std::string name;
        uint64_t material = 0;
        std::vector<glm::vec3> positions; // in the file's axes and units, as are the normals
        std::vector<glm::vec3> normals;   // one a position, or none
        std::vector<glm::vec3> colors;    // one a position, or none
        std::vector<glm::vec2> uvs;       // of the material's texture, v downwards; or none
        std::vector<glm::uvec3> triangles;
    };
    struct Texture // that lies in the file itself
    {
        std::string name; // as materials name it
        std::vector<std::byte> bytes;
    };

    std::vector<Material> materials;
    std::vector<Mesh> meshes; // one a mesh and node
    std::vector<Texture> textures;
};

/// Reads `file` in a process of its own: Assimp is known to crash, hang and hoard memory on damaged
/// files of many of its sixty formats, and nobody could check them all beforehand.
///
/// Every number is as the file has it, none has been checked. Files that it names are opened in its
/// folder alone (scan_folder.h). Throws Error(malformed) with Assimp's reason, or the way it
/// failed, and Error(unsupported) where it leads outside.
Import importWithAssimp(const std::filesystem::path& file, const ScanOptions& options,
                        const Progress& progress);

} // namespace relamp
