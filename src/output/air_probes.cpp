#include "output/air_probes.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "relight/obstacles.h"
#include "relight/relighter_state.h"
#include "relight/relit_page.h"
#include "relight/sky_bins.h"
#include "scan/surface_point.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfProbe = 512;
constexpr size_t kLooksAtLamp = 16; // from a probe
constexpr float kMostBacks = 0.25f; // share of rays that meet them in the open
constexpr uint32_t kNoLight = ~0u;

/// A way from a place in the air to a lamp; irradiance 0: it shines elsewhere.
Look lookAnywhere(const LightSource& source, glm::vec3 place, float share, glm::vec2 u)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {1.0f, -1.0f}) {
            glm::vec3 normal(0.0f);
            normal[axis] = side;
            const Look look = source.look(place, normal, share, u);
            if (look.irradiance <= 0.0f) continue;
            return source.look(place, look.direction, share, u);
        }
    return {};
}

} // namespace

struct AirProbes::State
{
    const Relighter::State& room;
    std::vector<glm::vec3> places;
    std::vector<uint32_t>
        met; // of rays: a surfel's front, behind these a bin of the sky; or kNoLight
    std::vector<uint8_t> isOpen;

    void cast(size_t probe);
    void addRays(size_t probe, std::span<const glm::vec3> radiance, WebHarmonics& sum) const;
    void addLamp(const ActiveLight& light, size_t probe, WebHarmonics& sum) const;
};

void AirProbes::State::cast(size_t probe)
{
    const Surfels& surfels = room.texels.surfels;
    size_t backs = 0;
    for (size_t i = 0; i < kRaysOfProbe; ++i) {
        const glm::vec3 direction = webDirectionOfRay(i, kRaysOfProbe);
        const Hit hit = room.scene.intersect(Ray{places[probe], direction});
        uint32_t& one = met[probe * kRaysOfProbe + i];
        if (hit.missed()) {
            one = static_cast<uint32_t>(surfels.count() + SkyBins::of(direction));
            continue;
        }
        one = hit.front ? surfels.find(places[probe] + hit.distance * direction,
                                       normalAt(room.texels, hit))
                        : kNoLight;
        if (!hit.front) ++backs;
    }
    isOpen[probe] = static_cast<float>(backs) < kMostBacks * static_cast<float>(kRaysOfProbe);
}

void AirProbes::State::addRays(size_t probe, std::span<const glm::vec3> radiance,
                               WebHarmonics& sum) const
{
    constexpr float kSolidAngle = 4.0f * kPi / static_cast<float>(kRaysOfProbe);
    for (size_t i = 0; i < kRaysOfProbe; ++i) {
        const uint32_t one = met[probe * kRaysOfProbe + i];
        if (one < radiance.size())
            sum.add(webDirectionOfRay(i, kRaysOfProbe), kSolidAngle * radiance[one]);
    }
}

/// Straight from a lamp: few rays would meet one that is small.
void AirProbes::State::addLamp(const ActiveLight& light, size_t probe, WebHarmonics& sum) const
{
    const bool isSun = light.source->isSun();
    const Obstacles obstacles(room.texels, room.scene,
                              isSun ? std::span<const uint8_t>(room.active.windowOpenings)
                                    : std::span<const uint8_t>(),
                              room.radiance.isClipped);
    for (size_t i = 0; i < kLooksAtLamp; ++i) {
        const float at = static_cast<float>(i) + 0.5f;
        const glm::vec2 u(at / static_cast<float>(kLooksAtLamp), std::fmod(0.618034f * at, 1.0f));
        const Look look = lookAnywhere(*light.source, places[probe], u.x, u);
        if (look.irradiance <= 0.0f) continue;
        const Ray ray{places[probe], look.direction, 0.0f, look.distance};
        uint8_t blocked = 0;
        obstacles.blocked({&ray, 1}, {&blocked, 1});
        if (blocked == 0)
            sum.add(look.direction,
                    look.irradiance / static_cast<float>(kLooksAtLamp) * light.emission);
    }
}

AirProbes::AirProbes(const Relighter& relighter, std::vector<glm::vec3> places)
    : state_(std::make_unique<State>(State{relighter.state(), std::move(places), {}, {}}))
{
    const size_t count = state_->places.size();
    state_->met.resize(count * kRaysOfProbe);
    state_->isOpen.resize(count);
    forEachChunk(count, 8, [&](size_t begin, size_t end) {
        for (size_t probe = begin; probe < end; ++probe) state_->cast(probe);
    });
}

AirProbes::~AirProbes() = default;

const std::vector<uint8_t>& AirProbes::isOpen() const
{
    return state_->isOpen;
}

std::vector<WebHarmonics> AirProbes::light() const
{
    const Relighter::State& room = state_->room;
    const std::span<const glm::vec3> irradiance = room.radiosity.onFronts();
    const std::vector<glm::vec3> albedo = reflecting(room);
    std::vector<glm::vec3> radiance(albedo.size()); // of fronts, what they reflect; and the sky
    for (size_t s = 0; s < irradiance.size(); ++s) radiance[s] = albedo[s] * irradiance[s] / kPi;
    radiance.insert(radiance.end(), room.active.sky.begin(), room.active.sky.end());
    std::vector<WebHarmonics> light(state_->places.size());
    forEachChunk(light.size(), 8, [&](size_t begin, size_t end) {
        for (size_t probe = begin; probe < end; ++probe) {
            state_->addRays(probe, radiance, light[probe]);
            for (const ActiveLight& lamp : room.active.lights)
                state_->addLamp(lamp, probe, light[probe]);
        }
    });
    return light;
}

glm::vec3 webDirectionOfRay(size_t i, size_t count)
{
    const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
    const float turn = std::fmod(0.61803398875f * static_cast<float>(i), 1.0f);
    const float r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    return {r * std::cos(2.0f * kPi * turn), r * std::sin(2.0f * kPi * turn), z};
}

} // namespace relamp
