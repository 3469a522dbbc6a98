#include "albedo/paint_prior.h"

#include "albedo/divide.shared.h"
#include "albedo/fill.h"
#include "albedo/paint_prior.shared.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "shading/lit_sides.shared.h"

#include <cstdint>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kSharpest = 0.05f;    // of log albedo: a surfel tells no more of those around
constexpr float kTooMuchLack = 1.25f; // times the light found: a scale that is off lacks less

// Numerics.
constexpr float kNothing = -1.0f;
constexpr int kRounds = 6; // each goes one ring further, by ever less
constexpr size_t kChunk = 1024;

/// What is believed of a surfel's paint.
struct Belief
{
    glm::vec3 log;
    float variance; // kNothing: nothing is known, and nothing is to be

    [[nodiscard]] bool isKnown() const { return variance >= 0.0f; }
};

/// Surfels that are not sure of their paint, each with those beside it that know something.
struct Unsure
{
    std::vector<uint32_t> surfel;
    std::vector<uint32_t> first{0}; // those of i: first[i] .. first[i + 1] - 1
    std::vector<uint32_t> beside;

    void add(const Surfels& surfels, uint32_t s, std::span<const Belief> beliefs)
    {
        surfel.push_back(s);
        for (const uint32_t n : surfels.neighborsOf(s))
            if (n != s && beliefs[n].isKnown() && surfels.areBeside(s, n)) beside.push_back(n);
        first.push_back(static_cast<uint32_t>(beside.size()));
    }

    [[nodiscard]] std::span<const uint32_t> besideOf(size_t i) const
    {
        return std::span(beside).subspan(first[i], first[i + 1] - first[i]);
    }
};

/// One belief, drawn to others.
Belief drawn(const Belief& own, std::span<const uint32_t> others, std::span<const Belief> beliefs)
{
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    float likely = 0.0f; // of them, that are of its paint
    for (const uint32_t n : others) {
        const Belief& other = beliefs[n];
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
                                   std::span<const float> variance)
{
    std::vector<Belief> beliefs(surfels.count());
    forEach(beliefs.size(), [&](size_t s) {
        beliefs[s] = {logOfPaint(albedo[s]), isKnown[s] != 0 ? variance[s] : kNothing};
    });
    Unsure unsure;
    for (uint32_t s = 0; s < beliefs.size(); ++s)
        if (isKnown[s] != 0 && variance[s] >= kSureOfPaint) unsure.add(surfels, s, beliefs);
    std::vector<Belief> next(unsure.surfel.size());
    for (int round = 0; round < kRounds; ++round) {
        forEachChunk(next.size(), kChunk, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                next[i] = drawn(beliefs[unsure.surfel[i]], unsure.besideOf(i), beliefs);
        });
        for (size_t i = 0; i < next.size(); ++i) beliefs[unsure.surfel[i]] = next[i];
    }
    std::vector<glm::vec3> paint(albedo.begin(), albedo.end());
    for (const uint32_t s : unsure.surfel) paint[s] = glm::exp(beliefs[s].log);
    return paint;
}

std::vector<glm::vec3> paintUnder(const LitSurfels& lit, std::span<const float> variance,
                                  float darkest)
{
    const SurfelRadiance& radiance = lit.radiance;
    std::vector<glm::vec3> paint(lit.surfels.count());
    std::vector<uint8_t> isKnown(lit.surfels.count());
    std::vector<uint8_t> isLit(lit.surfels.count()); // so that its light tells its paint
    for (size_t s = 0; s < isKnown.size(); ++s) {
        const glm::vec3 shading = lit.irradiance[s] / kPi;
        const glm::vec3 divided = dividedByShading(radiance.plain[s], shading, darkest);
        const float lack = lightThatLacks(divided);
        paint[s] = divided / lack;
        const bool isPlain = radiance.plainArea[s] > radiance.clippedArea[s];
        isKnown[s] = isPlain && lack < kTooMuchLack ? 1 : 0;
        const bool isOpen = lit.rims.empty() || lit.rims[s].albedo == 0.0f;
        isLit[s] = isKnown[s] != 0 && isOpen && brightestChannel(shading) >= darkest ? 1 : 0;
    }
    return paintAround(lit.surfels,
                       fillFromAround(lit.surfels, paint, isKnown, kAlbedoOfTheUnknown), isLit,
                       variance);
}

} // namespace relamp
