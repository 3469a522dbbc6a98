#include "relamp/light_probes.h"

#include "base/biweight.shared.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "relight/relighter_state.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kReach = 1.5f; // of the interpolation, in surfel sizes, as texels have it
constexpr size_t kProbeChunk = 1024;

struct Tap
{
    uint32_t surfel;
    float weight; // those of a place add up to 1
};

/// Surfels of the surface around a place: near, and facing alike.
void addTapsOf(const Surfels& surfels, const SurfacePlace& place, std::vector<Tap>& taps)
{
    const uint32_t home = surfels.find(place.position, place.normal);
    if (home == Surfels::kNone) return;
    const float perReachSquared = 1.0f / (kReach * kReach * surfels.size * surfels.size);
    const size_t first = taps.size();
    float sum = 0.0f;
    for (const uint32_t s : surfels.neighborsOf(home)) {
        const glm::vec3 way = surfels.position[s] - place.position;
        const float facing = std::max(glm::dot(place.normal, surfels.normal[s]), 0.0f);
        const float squared = facing * facing;
        const float weight = biweight(glm::dot(way, way) * perReachSquared) * squared * squared;
        if (weight <= 0.0f) continue;
        taps.push_back({s, weight});
        sum += weight;
    }
    if (taps.size() == first) {
        taps.push_back({home, 1.0f});
        sum = 1.0f;
    }
    for (size_t t = first; t < taps.size(); ++t) taps[t].weight /= sum;
}

} // namespace

struct LightProbes::State
{
    std::vector<uint32_t> firstTap; // one more than there are places
    std::vector<Tap> taps;
};

LightProbes::LightProbes(const Relighter& relighter, std::span<const SurfacePlace> places)
    : state_(std::make_unique<State>())
{
    const Surfels& surfels = relighter.state().texels.surfels;
    std::vector<std::vector<Tap>> found((places.size() + kProbeChunk - 1) / kProbeChunk);
    std::vector<uint32_t> counts(places.size());
    forEachChunk(places.size(), kProbeChunk, [&](size_t begin, size_t end) {
        std::vector<Tap>& taps = found[begin / kProbeChunk];
        for (size_t i = begin; i < end; ++i) {
            const size_t before = taps.size();
            addTapsOf(surfels, places[i], taps);
            counts[i] = static_cast<uint32_t>(taps.size() - before);
        }
    });
    state_->firstTap.push_back(0);
    for (const uint32_t count : counts) state_->firstTap.push_back(state_->firstTap.back() + count);
    state_->taps.reserve(state_->firstTap.back());
    for (const std::vector<Tap>& taps : found)
        state_->taps.insert(state_->taps.end(), taps.begin(), taps.end());
}

LightProbes::~LightProbes() = default;
LightProbes::LightProbes(LightProbes&&) noexcept = default;
LightProbes& LightProbes::operator=(LightProbes&&) noexcept = default;

std::vector<LightAtPlace> LightProbes::light(const Relighter& relighter) const
{
    const Relighter::State& room = relighter.state();
    const std::span<const glm::vec3> irradiance = room.radiosity.onFronts();
    std::vector<LightAtPlace> light(state_->firstTap.size() - 1);
    if (irradiance.empty()) return light;
    forEachChunk(light.size(), kProbeChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            for (uint32_t t = state_->firstTap[i]; t < state_->firstTap[i + 1]; ++t) {
                const Tap& tap = state_->taps[t];
                light[i].shading += tap.weight / kPi * irradiance[tap.surfel];
                if (room.active.shines[tap.surfel] != 0)
                    light[i].emission =
                        glm::max(light[i].emission, room.active.emission[tap.surfel]);
            }
    });
    return light;
}

} // namespace relamp
