#include "fit/told_lamp.h"

#include "base/radiometry.shared.h"
#include "lights/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kLevels = 7;  // between the brightest spot and the dimmest, by equal factors
constexpr float kAlike = 0.9f; // of the sharpest fall

/// A surfel, and the luminance of the darkest on the brightest way to it.
struct Reached
{
    uint32_t surfel;
    float level;
};

class BrightPiece
{
public:
    BrightPiece(const Surfels& surfels, const SurfelRadiance& radiance)
        : surfels_(surfels), shown_(surfels.count())
    {
        for (size_t s = 0; s < shown_.size(); ++s)
            shown_[s] = radiance.plainArea[s] > 0.0f ? luminance(radiance.plain[s]) : 1.0f;
    }

    /// Within kPointedAt; Surfels::kNone where there is no surface, or a black one.
    [[nodiscard]] uint32_t brightestNear(glm::vec3 place) const;
    [[nodiscard]] Glowing around(uint32_t start) const;

private:
    [[nodiscard]] std::vector<Reached> reachedFrom(uint32_t start) const;
    [[nodiscard]] float fallAround(std::span<const Reached> reached, std::span<const float> level,
                                   float from) const;
    [[nodiscard]] float sharpestEnd(std::span<const Reached> reached) const;

    const Surfels& surfels_;
    std::vector<float> shown_; // luminance
};

uint32_t BrightPiece::brightestNear(glm::vec3 place) const
{
    uint32_t best = Surfels::kNone;
    float most = kFaintest;
    for (uint32_t s = 0; s < shown_.size(); ++s)
        if (shown_[s] > most && glm::distance(surfels_.position[s], place) < kPointedAt) {
            best = s;
            most = shown_[s];
        }
    return best;
}

/// The brightest first, down to 1 / kUnsureLight of that. What faces up is left out, unless the
/// place does.
std::vector<Reached> BrightPiece::reachedFrom(uint32_t start) const
{
    const bool isLevel = surfels_.normal[start].y > kSameFacing;
    std::vector<Reached> reached;
    std::vector<uint8_t> isSeen(shown_.size(), 0);
    std::priority_queue<std::pair<float, uint32_t>> next;
    next.emplace(shown_[start], start);
    isSeen[start] = 1;
    for (float level = shown_[start];
         !next.empty() && next.top().first * kUnsureLight >= shown_[start];) {
        const auto [shown, s] = next.top();
        next.pop();
        level = std::min(level, shown);
        reached.push_back({s, level});
        for (const uint32_t n : surfels_.neighborsOf(s)) {
            if (isSeen[n] != 0 || (!isLevel && surfels_.normal[n].y > kSameFacing)) continue;
            isSeen[n] = 1;
            next.emplace(shown_[n], n);
        }
    }
    return reached;
}

/// By how much the surface is darker beyond the rim of what is reached at `from`: the mean log.
float BrightPiece::fallAround(std::span<const Reached> reached, std::span<const float> level,
                              float from) const
{
    double fall = 0.0;
    size_t steps = 0;
    for (const Reached& at : reached) {
        if (at.level < from) break;
        for (const uint32_t n : surfels_.neighborsOf(at.surfel)) {
            if (level[n] >= from) continue;
            fall += std::log(static_cast<double>(std::max(shown_[at.surfel], kFaintest) /
                                                 std::max(shown_[n], kFaintest)));
            ++steps;
        }
    }
    return static_cast<float>(fall / static_cast<double>(std::max<size_t>(steps, 1)));
}

/// Of levels that end about as sharply, the highest: what is mixed at the rim is left out.
float BrightPiece::sharpestEnd(std::span<const Reached> reached) const
{
    std::vector<float> level(shown_.size(), 0.0f);
    for (const Reached& at : reached) level[at.surfel] = at.level;
    std::array<float, kLevels> end{};
    std::array<float, kLevels> fall{};
    for (size_t k = 0; k < kLevels; ++k) {
        const float down = static_cast<float>(k + 1) / static_cast<float>(kLevels);
        end[k] = reached.front().level / std::pow(kUnsureLight, down);
        fall[k] = fallAround(reached, level, end[k]);
    }
    const float most = *std::ranges::max_element(fall);
    const float alike = std::min(most, kAlike * most); // below 0 where what is left out is brighter
    const auto first = std::ranges::find_if(fall, [&](float f) { return f >= alike; });
    return end[static_cast<size_t>(first - fall.begin())];
}

Glowing BrightPiece::around(uint32_t start) const
{
    const std::vector<Reached> reached = reachedFrom(start);
    Glowing piece{.from = sharpestEnd(reached)};
    for (const Reached& at : reached)
        if (at.level >= piece.from) piece.surfels.push_back(at.surfel);
    return piece;
}

/// Whether more of it than not can be seen as it is.
bool isMostlyPlain(const Glowing& piece, const SurfelRadiance& radiance)
{
    float more = 0.0f;
    for (const uint32_t s : piece.surfels) more += radiance.plainArea[s] - radiance.clippedArea[s];
    return more > 0.0f;
}

} // namespace

std::vector<Glowing> toldLamps(std::span<const glm::vec3> places, const Surfels& surfels,
                               const SurfelRadiance& radiance)
{
    if (places.empty()) return {};
    const BrightPiece pieces(surfels, radiance);
    std::vector<Glowing> told;
    for (const glm::vec3 place : places) {
        const uint32_t start = pieces.brightestNear(place);
        if (start == Surfels::kNone) continue;
        Glowing piece = pieces.around(start);
        if (isMostlyPlain(piece, radiance)) told.push_back(std::move(piece));
    }
    return told;
}

} // namespace relamp
