#include "thesis/fixtures.h"

#include "base/radiometry.shared.h"
#include "thesis/median_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace relamp
{
namespace
{

constexpr float kMergedFacing = 0.7f; // cosine; within about 45 degrees
constexpr float kAllAround = 0.5f;    // mean normal shorter than this: shines to all sides

glm::vec3 unitOrZero(glm::vec3 v)
{
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : glm::vec3(0.0f);
}

/// Sums that turn many patches into one light.
struct LightSum
{
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec3 intensity{0.0f};
    float weight = 0.0f;
    float squaredDistance = 0.0f;

    void add(glm::vec3 at, glm::vec3 facing, glm::vec3 light)
    {
        const float w = luminance(light);
        position += w * at;
        normal += w * facing;
        intensity += light;
        weight += w;
        squaredDistance += w * glm::dot(at, at);
    }

    [[nodiscard]] PointLight light() const
    {
        PointLight light;
        if (weight <= 0.0f) return light; // switched off: it is nowhere and counts for nothing
        light.position = position / weight;
        light.normal =
            glm::length(normal) > kAllAround * weight ? unitOrZero(normal) : glm::vec3(0.0f);
        light.intensity = intensity;
        const float spread = squaredDistance / weight - glm::dot(light.position, light.position);
        light.radius = std::sqrt(std::max(spread, 0.0f));
        return light;
    }
};

/// The fixture that most of a region's light comes from.
int fixtureOfMost(std::span<const Emitter> emitters, std::span<const uint32_t> region)
{
    std::map<int, float> lightOf;
    for (const uint32_t i : region)
        lightOf[emitters[i].fixture] += luminance(emitters[i].intensity);
    const auto isLess = [](const auto& a, const auto& b) { return a.second < b.second; };
    return std::max_element(lightOf.begin(), lightOf.end(), isLess)->first;
}

} // namespace

std::vector<Fixture> fixturesFrom(std::span<const Emitter> emitters, int count)
{
    std::vector<LightSum> sums(static_cast<size_t>(count));
    std::vector<Fixture> fixtures(static_cast<size_t>(count));
    for (const Emitter& e : emitters) {
        const auto f = static_cast<size_t>(e.fixture);
        sums[f].add(e.position, e.normal, e.intensity);
        fixtures[f].area += e.area;
        fixtures[f].radiance += e.intensity;
    }
    for (size_t f = 0; f < fixtures.size(); ++f) {
        const PointLight light = sums[f].light();
        fixtures[f].centre = light.position;
        fixtures[f].normal = light.normal;
        fixtures[f].radiance /= fixtures[f].area;
    }
    return fixtures;
}

std::vector<PointLight> pointLightsFrom(std::span<const Emitter> emitters, int levels)
{
    std::vector<CutPoint> points;
    points.reserve(emitters.size());
    for (const Emitter& e : emitters) points.push_back({e.position, luminance(e.intensity)});
    std::vector<PointLight> lights;
    for (const auto& region : medianCut(points, levels)) {
        LightSum sum;
        for (const uint32_t i : region)
            sum.add(emitters[i].position, emitters[i].normal, 0.25f * emitters[i].intensity);
        lights.push_back(sum.light());
        lights.back().fixture = fixtureOfMost(emitters, region);
    }
    return lights;
}

std::vector<PointLight> mergeLights(std::span<const PointLight> lights, float distance)
{
    std::vector<size_t> order(lights.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return luminance(lights[a].intensity) > luminance(lights[b].intensity);
    });
    struct Group
    {
        const PointLight* strongest;
        LightSum sum;
    };
    std::vector<Group> groups;
    for (const size_t i : order) {
        const PointLight& light = lights[i];
        if (luminance(light.intensity) <= 0.0f) continue;
        const auto belongs = [&](const Group& group) {
            const bool near = glm::distance(group.strongest->position, light.position) < distance;
            const bool unfacing =
                group.strongest->normal == glm::vec3(0.0f) || light.normal == glm::vec3(0.0f);
            return near &&
                   (unfacing || glm::dot(group.strongest->normal, light.normal) > kMergedFacing);
        };
        auto group = std::find_if(groups.begin(), groups.end(), belongs);
        if (group == groups.end()) group = groups.insert(groups.end(), {&light, {}});
        group->sum.add(light.position, light.normal, light.intensity);
    }
    std::vector<PointLight> merged;
    for (const Group& group : groups) {
        merged.push_back(group.sum.light());
        merged.back().fixture = group.strongest->fixture;
    }
    return merged;
}

} // namespace relamp
