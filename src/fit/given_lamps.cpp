#include "fit/given_lamps.h"

#include "shading/sampling.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;
constexpr float kMoved = 0.02f;       // m; a fixture that was moved farther is another
constexpr float kLeastRadius = 0.02f; // m, of something without a size
constexpr int kPatches = 32;

bool isDark(glm::vec3 light)
{
    return std::max({light.r, light.g, light.b}) <= 0.0f;
}

glm::vec3 centreOf(const FoundLamp& lamp)
{
    glm::vec3 sum(0.0f);
    float area = 0.0f;
    for (const ClippedPatch& patch : lamp.patches) {
        sum += patch.area * patch.position;
        area += patch.area;
    }
    return sum / area;
}

/// Patches of no surfel.
ClippedPatch patchAt(glm::vec3 position, glm::vec3 normal, float area)
{
    return {position, normal, area, Surfels::kNone};
}

std::vector<ClippedPatch> ball(glm::vec3 centre, float area)
{
    const float radius = std::max(std::sqrt(area / (4.0f * kPi)), kLeastRadius);
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 way = evenDirection(evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        patches.push_back(
            patchAt(centre + radius * way, way, 4.0f * kPi * radius * radius / kPatches));
    }
    return patches;
}

std::vector<ClippedPatch> disc(const Fixture& fixture)
{
    const float radius = std::max(std::sqrt(fixture.area / kPi), kLeastRadius);
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 over =
            cosineDirection(fixture.normal, evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        const glm::vec3 onDisc = over - glm::dot(over, fixture.normal) * fixture.normal;
        patches.push_back(patchAt(fixture.centre + radius * onDisc, fixture.normal,
                                  kPi * radius * radius / kPatches));
    }
    return patches;
}

FoundLamp lampOf(const Fixture& fixture, const FoundLamps& found)
{
    for (const FoundLamp& lamp : found.lamps)
        if (glm::distance(centreOf(lamp), fixture.centre) < kMoved)
            return {lamp.patches, fixture.radiance, fixture.error, lamp.onSides};
    const bool isFlat = fixture.normal != glm::vec3(0.0f);
    return {isFlat ? disc(fixture) : ball(fixture.centre, fixture.area),
            fixture.radiance,
            fixture.error,
            {}};
}

FoundLamp lampOf(const PointLight& light)
{
    const float radius = std::max(light.radius, kLeastRadius);
    return {ball(light.position, 4.0f * kPi * radius * radius),
            light.intensity / (kPi * radius * radius),
            glm::vec3(0.0f),
            {}};
}

} // namespace

FoundLamps asGiven(const Lights& given, const FoundLamps& found)
{
    FoundLamps lamps;
    lamps.ambient = given.ambient;
    for (const Fixture& fixture : given.fixtures)
        if (!isDark(fixture.radiance)) lamps.lamps.push_back(lampOf(fixture, found));
    for (const PointLight& light : given.points)
        if (light.fixture < 0 && !isDark(light.intensity)) lamps.lamps.push_back(lampOf(light));
    return lamps;
}

} // namespace relamp
