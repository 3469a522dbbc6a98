#include "relight/window_openings.h"

#include "lights/shining.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kUpright = 0.7f;      // upward part of its normal, less
constexpr float kLeastOpening = 0.1f; // m^2
constexpr float kBehind = 0.1f;       // m that a window's wall and its scan are thick
constexpr size_t kRays = 16;

bool isWindowOpening(const RayScene& scene, std::span<const ClippedPatch> patches)
{
    float area = 0.0f;
    glm::vec3 normal(0.0f);
    for (const ClippedPatch& patch : patches) {
        area += patch.area;
        normal += patch.area * patch.normal;
    }
    if (area < kLeastOpening || glm::length(normal) < 0.7f * area) return false; // small, or round
    normal = glm::normalize(normal);
    if (std::abs(normal.y) >= kUpright) return false;
    size_t open = 0;
    for (size_t i = 0; i < kRays; ++i) {
        const ClippedPatch& patch = patches[i * patches.size() / kRays];
        const Hit hit =
            scene.intersect({.origin = patch.position - kBehind * normal, .direction = -normal});
        if (hit.missed()) ++open;
    }
    return 4 * open >= 3 * kRays;
}

bool hasOutsideLight(const Relighting& lighting)
{
    return !isDark(lighting.sky.radiance) ||
           std::ranges::any_of(lighting.lights, [](const NewLight& light) {
               return light.type == LightType::sun && !isDark(light.emission);
           });
}

} // namespace

std::vector<uint8_t> likelyWindowOpenings(const RayScene& scene,
                                          std::span<const std::vector<ClippedPatch>> surfaces)
{
    std::vector<uint8_t> isOpening;
    for (const auto& patches : surfaces)
        isOpening.push_back(!patches.empty() && isWindowOpening(scene, patches) ? 1 : 0);
    return isOpening;
}

Relighting withWindowOpenings(Relighting lighting, const Lights& captured,
                              std::span<const uint8_t> isOpening)
{
    const bool isSaid =
        lighting.windowsAreSaid || std::ranges::any_of(lighting.fixtures, &LitFixture::isWindow);
    if (isSaid || !hasOutsideLight(lighting)) return lighting;
    for (LitFixture& lit : lighting.fixtures) {
        const size_t place = captured.placeOf(lit.fixture.id);
        if (place < isOpening.size() && isDark(lit.fixture.radiance))
            lit.isWindow = isOpening[place] != 0;
    }
    return lighting;
}

} // namespace relamp
