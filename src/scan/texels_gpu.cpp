#include "scan/texels_gpu.h"

#include "base/half.h"
#include "scan/ray_tree.h"

#include <bit>
#include <cmath>

#include <glm/packing.hpp>

namespace relamp
{
namespace
{

constexpr float kMillimetresPerMetre = 1e3f;

uint32_t packedNormal(glm::vec3 normal)
{
    return glm::packSnorm2x16(octahedral(normal));
}

uint32_t packed(float low, float high)
{
    return halfFromFloat(low) | uint32_t{halfFromFloat(high)} << 16;
}

std::vector<glm::uvec4> sitesOf(const Texels& texels, size_t page)
{
    const TexelLoader loader(texels, page);
    std::vector<glm::uvec4> sites(texels.pages[page].count());
    forEachBlock(texels.pages[page], [&](size_t begin, size_t count) {
        TexelBlock block;
        loader.loadGeometry(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            sites[begin + i] = {std::bit_cast<uint32_t>(block.x[i]),
                                std::bit_cast<uint32_t>(block.y[i]),
                                std::bit_cast<uint32_t>(block.z[i]),
                                packedNormal({block.nx[i], block.ny[i], block.nz[i]})};
    });
    return sites;
}

std::vector<glm::uvec2> radianceOf(const Texels& texels, size_t page,
                                   const Linearization& linearization)
{
    const TexelLoader loader(texels, page, &linearization);
    std::vector<glm::uvec2> radiance(texels.pages[page].count());
    forEachBlock(texels.pages[page], [&](size_t begin, size_t count) {
        TexelBlock block;
        loader.loadRadiance(begin, count, block);
        loader.loadArea(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            radiance[begin + i] = {
                packed(block.r[i], block.g[i]),
                packed(block.b[i], kMillimetresPerMetre * std::sqrt(block.area[i]))};
    });
    return radiance;
}

std::vector<uint32_t> surfelsOfTexels(const PageTexels& page)
{
    std::vector<uint32_t> surfels(page.count());
    for (size_t run = 0; run + 1 < page.runs.size(); ++run)
        std::fill(surfels.begin() + page.runs[run].begin,
                  surfels.begin() + page.runs[run + 1].begin, page.runs[run].surfel);
    return surfels;
}

std::vector<glm::uvec2> runsOf(const PageTexels& page)
{
    std::vector<glm::uvec2> runs;
    for (const PageTexels::Run& run : page.runs) runs.emplace_back(run.surfel, run.begin);
    return runs;
}

std::vector<glm::vec4> withFourth(const std::vector<glm::vec3>& values,
                                  const std::vector<float>& fourth)
{
    std::vector<glm::vec4> both(values.size());
    for (size_t i = 0; i < both.size(); ++i) both[i] = glm::vec4(values[i], fourth[i]);
    return both;
}

void addTriangles(const Scan& scan, uint32_t meshIndex, std::vector<SurfaceTriangle>& triangles)
{
    const Mesh& mesh = scan.meshes[meshIndex];
    const bool ofVertices = scan.pages[static_cast<size_t>(mesh.page)].ofVertices;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        SurfaceTriangle triangle{};
        triangle.mesh = meshIndex;
        for (int c = 0; c < 3; ++c)
            triangle.normals[c] = packedNormal(mesh.normals[3 * t + static_cast<size_t>(c)]);
        if (ofVertices) {
            for (int c = 0; c < 3; ++c) {
                const auto pixel = static_cast<uint32_t>(mesh.firstPixel + mesh.triangles[t][c]);
                triangle.corners[c] = {std::bit_cast<float>(pixel), 0.0f};
            }
        } else {
            const PixelTriangle pixels = pixelTriangle(scan, mesh, mesh.triangles[t]);
            for (int c = 0; c < 3; ++c) triangle.corners[c] = pixels.corner[c];
        }
        triangles.push_back(triangle);
    }
}

std::vector<SurfaceTriangle> trianglesOf(const Scan& scan)
{
    std::vector<SurfaceTriangle> triangles;
    triangles.reserve(scan.triangleCount());
    for (uint32_t m = 0; m < scan.meshes.size(); ++m) addTriangles(scan, m, triangles);
    return triangles;
}

std::vector<SurfaceMesh> meshesOf(const Scan& scan)
{
    std::vector<SurfaceMesh> meshes;
    for (const Mesh& mesh : scan.meshes) {
        const Page& page = scan.pages[static_cast<size_t>(mesh.page)];
        meshes.push_back({static_cast<uint32_t>(mesh.page), static_cast<uint32_t>(page.image.width),
                          static_cast<uint32_t>(page.image.height), page.ofVertices ? 1u : 0u,
                          mesh.wrapU == Wrap::repeat ? 1u : 0u,
                          mesh.wrapV == Wrap::repeat ? 1u : 0u});
    }
    return meshes;
}

} // namespace

GpuTexels::GpuTexels(const gpu::Device& device, const Texels& texels, size_t page,
                     const Linearization& linearization)
    : count(texels.pages[page].count()),
      width(static_cast<uint32_t>(texels.scan->pages[page].image.width)),
      height(static_cast<uint32_t>(texels.scan->pages[page].image.height)),
      site(device, sitesOf(texels, page)),
      radiance(device, radianceOf(texels, page, linearization)),
      pixel(device, texels.pages[page].pixel), surfel(device, surfelsOfTexels(texels.pages[page])),
      runs(device, runsOf(texels.pages[page])), runCount(texels.pages[page].runs.size() - 1)
{}

size_t GpuTexels::bytesOf(const Texels& texels, size_t page)
{
    return texels.pages[page].count() *
               (sizeof(glm::uvec4) + sizeof(glm::uvec2) + 2 * sizeof(uint32_t)) +
           texels.pages[page].runs.size() * sizeof(glm::uvec2);
}

GpuSurfels::GpuSurfels(const gpu::Device& device, const Surfels& surfels)
    : count(surfels.count()), size(surfels.size),
      position(device, withFourth(surfels.position, surfels.area)),
      normal(device, withFourth(surfels.normal, std::vector<float>(surfels.count()))),
      firstNeighbor(device, surfels.firstNeighbor), neighbor(device, surfels.neighbor)
{}

GpuSurface::GpuSurface(const gpu::Device& device, const Scan& scan)
    : GpuSurface(device, scan, RayTree(scan))
{}

GpuSurface::GpuSurface(const gpu::Device& device, const Scan& scan, const RayTree& tree)
    : nodes(device, tree.nodes), boxedTriangles(device, tree.triangles),
      triangles(device, trianglesOf(scan)), meshes(device, meshesOf(scan))
{}

} // namespace relamp
