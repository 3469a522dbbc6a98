#include "albedo/doubts.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/ramp.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kFewMiss = 0.6f;    // share of rays
constexpr float kMostMiss = 0.95f;  // likewise; more, and its light is a guess
constexpr float kFewBacks = 0.5f;   // share of rays that meet something
constexpr float kMostBacks = 0.9f;  // likewise
constexpr float kAround = 1.7f;     // surfel sizes
constexpr float kSameFacing = 0.9f; // cosine
constexpr float kLeastStep = 0.1f;  // RMS, in log irradiance; less is no edge
constexpr float kAgree = 0.4f;      // of the shading's steps: what it leaves unexplained
constexpr float kDisagree = 1.2f;   // more is left than there was
constexpr float kLeastTrust = 0.1f; // a wrong edge changes brightness; the pattern stays known
constexpr float kSlightCorrection = 0.1f; // of log light; so far it is as likely right as wrong
constexpr float kGreatCorrection = 0.4f;  // likewise; a guess

float logOf(glm::vec3 rgb)
{
    return logOfLight(luminance(rgb));
}

/// Share of the shading's steps around a surfel that the texture does not take, and as large as
/// these are.
class Steps
{
public:
    Steps(const Surfels& surfels, const SurfelRadiance& radiance,
          std::span<const glm::vec3> irradiance)
        : surfels_(surfels), radiance_(radiance), irradiance_(irradiance)
    {}

    [[nodiscard]] float unexplained(size_t s) const
    {
        float left = 0.0f;
        float all = 0.0f;
        float count = 0.0f;
        for (const uint32_t n : surfels_.neighborsOf(s)) {
            if (n == s || !isBeside(s, n) || !isHardlyBurntOut(radiance_, n)) continue;
            const float light = logOf(irradiance_[n]) - logOf(irradiance_[s]);
            const float seen = logOf(radiance_.plain[n]) - logOf(radiance_.plain[s]);
            left += (seen - light) * (seen - light);
            all += light * light;
            count += 1.0f;
        }
        return all > kLeastStep * kLeastStep * count ? std::sqrt(left / all) : 0.0f;
    }

private:
    [[nodiscard]] bool isBeside(size_t s, size_t n) const
    {
        const glm::vec3 way = surfels_.position[n] - surfels_.position[s];
        return glm::dot(way, way) < kAround * kAround * surfels_.size * surfels_.size &&
               glm::dot(surfels_.normal[s], surfels_.normal[n]) > kSameFacing;
    }

    const Surfels& surfels_;
    const SurfelRadiance& radiance_;
    std::span<const glm::vec3> irradiance_;
};

} // namespace

std::vector<SurfelTrust> trustByView(const HitLists& hits, size_t surfels)
{
    std::vector<SurfelTrust> trust(surfels);
    forEachChunk(surfels, 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            const std::span targets = hits.targetsOf(s); // fronts come first
            float missed = 0.0f;
            float backs = 0.0f;
            for (const HitTarget target : targets) {
                if (target.isNothing())
                    missed += 1.0f;
                else if (target.side().isBack())
                    backs += 1.0f;
            }
            const auto rays = static_cast<float>(targets.size());
            trust[s].seen = ramp(kMostMiss, kFewMiss, missed / rays);
            trust[s].front = ramp(kMostBacks, kFewBacks, backs / std::max(rays - missed, 1.0f));
        }
    });
    return trust;
}

void doubtEdges(const Surfels& surfels, const SurfelRadiance& radiance, const SurfelLighting& light,
                std::span<SurfelTrust> trust)
{
    const Steps steps(surfels, radiance, light.irradiance);
    forEachChunk(trust.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            if (light.inPenumbra[s] != 0 && isHardlyBurntOut(radiance, s))
                trust[s].edges =
                    std::max(ramp(kDisagree, kAgree, steps.unexplained(s)), kLeastTrust);
    });
}

void doubtCorrections(std::span<const float> lit, std::span<SurfelTrust> trust)
{
    for (size_t s = 0; s < lit.size(); ++s) {
        const float size = std::abs(logOfLight(lit[s]));
        const float left = ramp(kGreatCorrection, kSlightCorrection, size);
        trust[s].edges = std::min(trust[s].edges, std::max(left, kLeastTrust));
    }
}

} // namespace relamp
