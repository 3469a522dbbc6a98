#pragma once

#include "fuzz/fuzz.h"
#include "scan/gltf_read.h"
#include "scan/gltf_write.h"

#include <algorithm>
#include <cmath>

namespace relamp::fuzz
{

/// Reads a glTF file, checks what Mesh promises, writes it back and reads that.
inline void readAndWriteGltf(std::span<const std::byte> bytes)
{
    Progress progress;
    const Scan scan = readGltf(bytes, "fuzz.glb", {}, progress);
    std::vector<RelitPage> pages(scan.pages.size());
    for (const Mesh& mesh : scan.meshes) {
        for (const glm::vec3& p : mesh.positions)
            if (!std::isfinite(p.x + p.y + p.z)) std::abort();
        for (const glm::uvec3& t : mesh.triangles)
            if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) std::abort();
    }
    for (size_t p = 0; p < pages.size(); ++p) {
        pages[p].vertexAlbedo.assign(
            scan.pages[p].ofVertices ? 3 * scan.pages[p].image.pixels() : 0, 0.5f);
        pages[p].albedo = {{1, 2, 3}, "image/png"};
    }
    Lights lights;
    lights.points.push_back({.intensity = glm::vec3(1.0f)});
    const std::string written = writeGlb(scan, pages, lights);
    if (std::all_of(scan.pages.begin(), scan.pages.end(),
                    [](const Page& page) { return page.ofVertices; }))
        readGltf(std::as_bytes(std::span(written)), "fuzz.glb", {}, progress);
}

} // namespace relamp::fuzz
