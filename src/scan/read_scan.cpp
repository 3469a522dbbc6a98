#include "relamp/scan.h"

#include "base/file.h"
#include "scan/assimp_read.h"
#include "scan/gltf_read.h"
#include "scan/ply_read.h"
#include "scan/scan_limits.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

std::string lowerExtension(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isGlb(std::span<const std::byte> bytes)
{
    return bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF",
                                           [](std::byte b, char c) { return b == std::byte(c); });
}

Scan readByFormat(const std::filesystem::path& file, const ScanOptions& options, Progress& progress)
{
    const std::vector<std::byte> bytes = readFile(file);
    const std::string extension = lowerExtension(file);
    if (isGlb(bytes) || extension == ".gltf" || extension == ".glb")
        return readGltf(bytes, file, options, progress);
    if (isPly(bytes) || extension == ".ply") return readPly(bytes, file, options, progress);
    return readWithAssimp(bytes, file, options, progress);
}

} // namespace

size_t Scan::triangleCount() const
{
    size_t count = 0;
    for (const Mesh& mesh : meshes) count += mesh.triangles.size();
    return count;
}

std::string Scan::title() const
{
    return file.empty() ? name : file.string();
}

Bounds boundsOf(const Scan& scan)
{
    constexpr float kFar = std::numeric_limits<float>::max();
    Bounds bounds{glm::vec3(kFar), glm::vec3(-kFar)};
    for (const Mesh& mesh : scan.meshes)
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int c = 0; c < 3; ++c) {
                bounds.low = glm::min(bounds.low, mesh.positions[triangle[c]]);
                bounds.high = glm::max(bounds.high, mesh.positions[triangle[c]]);
            }
    return bounds.low.x > bounds.high.x ? Bounds{} : bounds;
}

Scan readScan(const std::filesystem::path& file, const ScanOptions& options, Progress& progress)
{
    const Progress::Stage stage(progress, "read");
    Scan scan = readByFormat(file, options, progress);
    scan.file = file;
    scan.options = options;
    checkCounts(scan, file.string());
    shortenWarnings(scan.warnings);
    if (options.longestSide > 0) return coarsened(std::move(scan), options.longestSide);
    return scan;
}

} // namespace relamp
