#include "scan/surface_point.h"

#include "base/parallel.h"
#include "scan/wrap.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

struct MeshTriangle
{
    const Mesh& mesh;
    size_t triangle; // of the mesh
};

MeshTriangle triangleOf(const Texels& texels, uint32_t facet)
{
    const uint32_t mesh = texels.facets.meshOf[facet];
    return {texels.scan->meshes[mesh], facet - texels.facets.firstOfMesh[mesh]};
}

uint32_t wrapped(double pixel, int size, Wrap wrap)
{
    return static_cast<uint32_t>(
        wrappedPixel(static_cast<float>(pixel), static_cast<float>(size), wrap == Wrap::repeat));
}

/// Pixel coordinates of the point that has these shares of a triangle's corners.
glm::dvec2 pointOn(const Texels& texels, const Mesh& mesh, const glm::uvec3& v, glm::vec3 weights)
{
    const PixelTriangle t = pixelTriangle(*texels.scan, mesh, v);
    return static_cast<double>(weights.x) * t.corner[0] +
           static_cast<double>(weights.y) * t.corner[1] +
           static_cast<double>(weights.z) * t.corner[2];
}

} // namespace

PixelAt nearestPixelAt(const Texels& texels, const Hit& hit)
{
    const auto [mesh, triangle] = triangleOf(texels, hit.triangle);
    const glm::uvec3& v = mesh.triangles[triangle];
    const glm::vec3 weights(1.0f - hit.weights.x - hit.weights.y, hit.weights.x, hit.weights.y);
    const Page& page = texels.scan->pages[static_cast<size_t>(mesh.page)];
    const auto pageIndex = static_cast<uint32_t>(mesh.page);
    if (page.ofVertices) {
        const int corner = weights.x >= weights.y && weights.x >= weights.z ? 0
                           : weights.y >= weights.z                         ? 1
                                                                            : 2;
        return {pageIndex, static_cast<uint32_t>(mesh.firstPixel + v[corner])};
    }
    const glm::dvec2 at = pointOn(texels, mesh, v, weights);
    const uint32_t column = wrapped(std::round(at.x), page.image.width, mesh.wrapU);
    const uint32_t row = wrapped(std::round(at.y), page.image.height, mesh.wrapV);
    return {pageIndex, row * static_cast<uint32_t>(page.image.width) + column};
}

NearestPixels::NearestPixels(const Texels& texels)
    : texels_(texels), triangles_(texels.facets.triangles)
{
    forEachChunk(triangles_.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto [mesh, triangle] = triangleOf(texels, static_cast<uint32_t>(i));
            const Page& page = texels.scan->pages[static_cast<size_t>(mesh.page)];
            if (page.ofVertices) continue;
            const PixelTriangle t = pixelTriangle(*texels.scan, mesh, mesh.triangles[triangle]);
            triangles_[i] = {.corner = glm::vec2(t.corner[0] + 0.5), // that cutting off rounds
                             .second = glm::vec2(t.corner[1] - t.corner[0]),
                             .third = glm::vec2(t.corner[2] - t.corner[0]),
                             .end = glm::vec2(page.image.width, page.image.height),
                             .page = static_cast<uint32_t>(mesh.page),
                             .width = static_cast<uint32_t>(page.image.width)};
        }
    });
}

PixelAt NearestPixels::at(const Hit& hit) const
{
    const OnPage& on = triangles_[hit.triangle];
    const glm::vec2 pixel = on.corner + hit.weights.x * on.second + hit.weights.y * on.third;
    const bool isOn =
        pixel.x >= 0.0f && pixel.y >= 0.0f && pixel.x < on.end.x && pixel.y < on.end.y;
    if (!isOn) return nearestPixelAt(texels_, hit);
    return {on.page, static_cast<uint32_t>(pixel.y) * on.width + static_cast<uint32_t>(pixel.x)};
}

PixelMix pixelsAt(const Texels& texels, const Hit& hit)
{
    const auto [mesh, triangle] = triangleOf(texels, hit.triangle);
    const glm::uvec3& v = mesh.triangles[triangle];
    const glm::vec3 weights(1.0f - hit.weights.x - hit.weights.y, hit.weights.x, hit.weights.y);
    PixelMix mix;
    mix.page = static_cast<uint32_t>(mesh.page);
    const Page& page = texels.scan->pages[mix.page];
    if (page.ofVertices) {
        const auto base = static_cast<uint32_t>(mesh.firstPixel);
        mix.pixel = {base + v.x, base + v.y, base + v.z, base + v.x};
        mix.weight = {weights.x, weights.y, weights.z, 0.0f};
        return mix;
    }
    const glm::dvec2 at = pointOn(texels, mesh, v, weights);
    const glm::dvec2 low(std::floor(at.x), std::floor(at.y));
    const auto fx = static_cast<float>(at.x - low.x);
    const auto fy = static_cast<float>(at.y - low.y);
    const Image& image = page.image;
    const uint32_t x0 = wrapped(low.x, image.width, mesh.wrapU);
    const uint32_t x1 = wrapped(low.x + 1.0, image.width, mesh.wrapU);
    const uint32_t row0 =
        wrapped(low.y, image.height, mesh.wrapV) * static_cast<uint32_t>(image.width);
    const uint32_t row1 =
        wrapped(low.y + 1.0, image.height, mesh.wrapV) * static_cast<uint32_t>(image.width);
    mix.pixel = {row0 + x0, row0 + x1, row1 + x0, row1 + x1};
    mix.weight = {(1.0f - fx) * (1.0f - fy), fx * (1.0f - fy), (1.0f - fx) * fy, fx * fy};
    return mix;
}

glm::vec3 normalAt(const Texels& texels, const Hit& hit)
{
    const auto [mesh, triangle] = triangleOf(texels, hit.triangle);
    const glm::vec3* n = &mesh.normals[3 * triangle];
    const float first = 1.0f - hit.weights.x - hit.weights.y;
    return glm::normalize(first * n[0] + hit.weights.x * n[1] + hit.weights.y * n[2]);
}

} // namespace relamp
