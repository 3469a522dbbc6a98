#include "albedo/paint_prior.h"

#include "albedo/paint_prior.shared.h"
#include "base/parallel.h"

#include <cstdint>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kSharpest = 0.05f; // of log albedo: a surfel tells no more of those around

// Numerics.
constexpr int kRounds = 6; // each goes one ring further, by ever less
constexpr size_t kChunk = 1024;

/// What is believed of a surfel's paint.
struct Belief
{
    glm::vec3 log;
    float variance; // < 0: nothing is known, and nothing is to be
};

/// A round: what is not sure, by those of its surface beside it.
Belief drawn(const Surfels& surfels, uint32_t s, std::span<const Belief> beliefs)
{
    const Belief& own = beliefs[s];
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    float likely = 0.0f; // of them, that are of its paint
    for (const uint32_t n : surfels.neighborsOf(s)) {
        const Belief& other = beliefs[n];
        if (n == s || other.variance < 0.0f || !surfels.areBeside(s, n)) continue;
        const float like = likenessOfPaints(other.log - own.log, own.variance + other.variance);
        const float weight = like / (other.variance + kSharpest * kSharpest);
        sum += like * weight * other.log;
        likely += like * weight;
        weights += weight;
    }
    if (likely <= 0.0f) return own;
    const float spread = kPaintSpread * kPaintSpread + 1.0f / likely;
    const float share = own.variance / (own.variance + spread) * likely / weights;
    return {own.log + share * (sum / likely - own.log), own.variance * (1.0f - share)};
}

} // namespace

std::vector<glm::vec3> paintAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                   std::span<const uint8_t> isKnown,
                                   std::span<const SurfelTrust> trust)
{
    std::vector<Belief> beliefs(surfels.count());
    std::vector<uint32_t> unsure;
    for (uint32_t s = 0; s < beliefs.size(); ++s) {
        const glm::vec3 trusted(trust[s].seen, trust[s].front, trust[s].edges);
        beliefs[s] = {logOfPaint(albedo[s]), isKnown[s] != 0 ? varianceOfAlbedo(trusted) : -1.0f};
        if (isKnown[s] != 0 && !isTrustedByAll(trusted)) unsure.push_back(s);
    }
    std::vector<Belief> next(unsure.size());
    for (int round = 0; round < kRounds; ++round) {
        forEachChunk(unsure.size(), kChunk, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) next[i] = drawn(surfels, unsure[i], beliefs);
        });
        for (size_t i = 0; i < unsure.size(); ++i) beliefs[unsure[i]] = next[i];
    }
    std::vector<glm::vec3> paint(albedo.begin(), albedo.end());
    for (const uint32_t s : unsure) paint[s] = glm::exp(beliefs[s].log);
    return paint;
}

} // namespace relamp
