#include "thesis/rsm.h"

#include "base/parallel.h"
#include "scan/surface_point.h"
#include "thesis/rsm.shared.h"

#include <algorithm>
#include <array>

namespace relamp
{
namespace
{

constexpr float kOffLight = 0.02f; // m
constexpr int kFaces = 6;
constexpr int kTile = 4; // rays of 4 x 4 pixels go together: one packet

struct MapPixel
{
    glm::vec3 direction;
    float solidAngle;
};

/// Directions of all pixels of a cube, tile after tile, so that neighbours in the list are in
/// space.
std::vector<MapPixel> pixelsOfCube(int resolution)
{
    std::vector<MapPixel> pixels;
    pixels.reserve(static_cast<size_t>(kFaces) * static_cast<size_t>(resolution) *
                   static_cast<size_t>(resolution));
    const auto n = static_cast<float>(resolution);
    for (int face = 0; face < kFaces; ++face)
        for (int ty = 0; ty < resolution; ty += kTile)
            for (int tx = 0; tx < resolution; tx += kTile)
                for (int y = ty; y < std::min(ty + kTile, resolution); ++y)
                    for (int x = tx; x < std::min(tx + kTile, resolution); ++x) {
                        const float u = (2.0f * static_cast<float>(x) + 1.0f) / n - 1.0f;
                        const float v = (2.0f * static_cast<float>(y) + 1.0f) / n - 1.0f;
                        pixels.push_back({cubeDirection(face, u, v), cubePixelSolidAngle(u, v, n)});
                    }
    return pixels;
}

} // namespace

glm::vec3 viewpointOf(const PointLight& light)
{
    return light.position + kOffLight * light.normal;
}

std::vector<BounceLight> reflectiveShadowMaps(const Texels& texels, const RayScene& scene,
                                              std::span<const PointLight> lights, int resolution)
{
    constexpr size_t kChunk = 256;
    const std::vector<MapPixel> pixels = pixelsOfCube(resolution);
    const size_t chunksPerLight = (pixels.size() + kChunk - 1) / kChunk;
    std::vector<std::vector<BounceLight>> found(lights.size() * chunksPerLight);
    forEach(found.size(), [&](size_t task) {
        const PointLight& light = lights[task / chunksPerLight];
        const size_t begin = task % chunksPerLight * kChunk;
        const size_t count = std::min(kChunk, pixels.size() - begin);
        std::array<Ray, kChunk> rays;
        std::array<Hit, kChunk> hits;
        for (size_t i = 0; i < count; ++i)
            rays[i] = {.origin = viewpointOf(light), .direction = pixels[begin + i].direction};
        scene.intersect(std::span(rays).first(count), std::span(hits).first(count),
                        RayOrder::coherent);
        found[task].reserve(count);
        for (size_t i = 0; i < count; ++i) {
            if (hits[i].missed() || !hits[i].front) continue;
            const auto [page, pixel] = nearestPixelAt(texels, hits[i]);
            found[task].push_back({rays[i].origin + hits[i].distance * rays[i].direction,
                                   normalAt(texels, hits[i]),
                                   light.intensity * pixels[begin + i].solidAngle, page, pixel});
        }
    });
    std::vector<BounceLight> all;
    size_t count = 0;
    for (const auto& list : found) count += list.size();
    all.reserve(count);
    for (const auto& list : found) all.insert(all.end(), list.begin(), list.end());
    return all;
}

} // namespace relamp
