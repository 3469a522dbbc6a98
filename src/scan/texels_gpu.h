#pragma once

#include "gpu/buffer.h"
#include "scan/texels.gpu.h"
#include "scan/texels.h"

namespace relamp
{

/// What does not change of the texels of one page, in their order.
struct GpuTexels
{
    GpuTexels(const gpu::Device& device, const Texels& texels, size_t page,
              const Linearization& linearization = {});

    size_t count;
    uint32_t width; // of the page, pixels
    uint32_t height;
    gpu::Array<glm::uvec4> site;     // positionOf, normalOf
    gpu::Array<glm::uvec2> radiance; // halves: linear RGB, and width of the texel in mm
    gpu::Array<uint32_t> pixel;
    gpu::Array<uint32_t> surfel;
    gpu::Array<glm::uvec2> runs; // surfel, first texel; one more than there are
    size_t runCount;

    [[nodiscard]] size_t pixels() const { return size_t{width} * height; }
    /// Bytes that all of it takes on a device.
    static size_t bytesOf(const Texels& texels, size_t page);
};

/// Surfels and their neighbours.
struct GpuSurfels
{
    GpuSurfels(const gpu::Device& device, const Surfels& surfels);

    size_t count;
    float size;                     // m
    gpu::Array<glm::vec4> position; // w: area, m^2
    gpu::Array<glm::vec4> normal;
    gpu::Array<uint32_t> firstNeighbor;
    gpu::Array<uint32_t> neighbor;
};

/// The surface as rays meet it (scan/trace.glsl), and what they find there.
struct GpuSurface
{
    GpuSurface(const gpu::Device& device, const Scan& scan);

    gpu::Array<glm::uvec4> nodes;
    gpu::Array<glm::uvec4> boxedTriangles;
    gpu::Array<SurfaceTriangle> triangles; // by facet
    gpu::Array<SurfaceMesh> meshes;

private:
    GpuSurface(const gpu::Device& device, const Scan& scan, const struct RayTree& tree);
};

} // namespace relamp
