#include "output/room_view.h"

#include "scan/surface_point.h"

#include <limits>
#include <optional>

namespace relamp
{
namespace
{

/// The first front that a ray meets behind the back that it met.
Hit frontBehind(const RayScene& scene, Ray ray, Hit hit)
{
    constexpr int kMostBacks = 64; // a ray that slides along a wall may meet one again and again
    constexpr float kOnward = 1e-4f;
    for (int i = 0; i < kMostBacks && !hit.missed() && !hit.front; ++i) {
        ray.nearest = hit.distance * (1.0f + kOnward) + kOnward;
        hit = scene.intersect(ray);
    }
    return hit;
}

/// Radiance of the first lamp that a ray meets before it hits a surface.
std::optional<glm::vec3> lampBefore(const Hit& hit, const Ray& ray,
                                    const std::vector<SeenLamp>& lamps)
{
    float nearest = hit.missed() ? std::numeric_limits<float>::max() : hit.distance;
    std::optional<glm::vec3> radiance;
    for (const SeenLamp& lamp : lamps) {
        const auto glow = lamp.along(ray);
        if (!glow || glow->distance >= nearest) continue;
        nearest = glow->distance;
        radiance = glow->radiance;
    }
    return radiance;
}

} // namespace

RoomView::RoomView(const Texels& texels, const RayScene& scene)
    : texels_(texels), scene_(scene), charts_(texels), box_(boundsOf(*texels.scan))
{}

std::vector<glm::vec3> RoomView::look(const CameraRays& camera, int samples,
                                      std::span<const Image> pages, const Surroundings& around,
                                      Progress& progress) const
{
    const std::vector<Radiance> radiance(pages.begin(), pages.end());
    const auto width = static_cast<size_t>(camera.size().width);
    const auto height = static_cast<size_t>(camera.size().height);
    const int rays = samples * samples;
    const float share = 1.0f / static_cast<float>(rays);
    const bool throughBacks = !box_.contains(camera.position());
    const auto seen = [&](const Ray& ray, Hit hit) {
        if (throughBacks) hit = frontBehind(scene_, ray, hit);
        if (const auto glow = lampBefore(hit, ray, around.lamps)) return *glow;
        if (hit.missed()) return around.beyond(ray.direction);
        if (!hit.front) return glm::vec3(0.0f);
        PixelMix mix = pixelsAt(texels_, hit);
        charts_.keepToChart(hit.triangle, mix);
        glm::vec3 sum(0.0f);
        for (size_t k = 0; k < 4; ++k) sum += mix.weight[k] * radiance[mix.page][mix.pixel[k]];
        return sum;
    };

    constexpr size_t kRows = 8;
    Progress::Stage stage(progress, "picture", height);
    std::vector<glm::vec3> picture(width * height, glm::vec3(0.0f));
    forEachChunk(height, kRows, [&](size_t begin, size_t end) {
        RowOfRays row;
        for (size_t y = begin; y < end; ++y) {
            glm::vec3* line = &picture[y * width];
            lookAlong(static_cast<int>(y), rays, camera, scene_, row,
                      [&](size_t x, const Ray& ray, const Hit& hit) {
                          line[x] += share * seen(ray, hit);
                      });
        }
        stage.advance(end - begin);
    });
    return picture;
}

} // namespace relamp
