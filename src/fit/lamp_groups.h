#pragma once

#include "lights/candidates.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Candidates that are fitted as one lamp.
struct LampGroup
{
    Candidate whole;
    std::vector<uint32_t> ends; // of each single lamp in `whole.patches`; empty: it is one
    bool isGiven = false;       // a person says that it shines; it stays by itself
};

struct LampGroups
{
    std::vector<LampGroup> groups; // in the order of their largest lamps
    size_t leftOut = 0;            // candidates of at least kSpeck beyond the most
    float areaLeftOut = 0.0f;      // of these, m^2
};

/// Ratio of areas, and of radiances, of lamps of one model.
inline constexpr float kAboutEqual = 3.0f;

/// Whether their areas are about the same.
bool areOfOneSize(const Candidate& a, const Candidate& b);

/// Whether two pieces look like the same model of lamp, as the panels of a ceiling do.
bool areAlike(const Candidate& a, const Candidate& b);

/// Takes alike neighbours together where `candidates`, largest first, are more than `most` and what
/// is beyond might be lamps; up to half of `most` groups come of it. Else every one stays by
/// itself. What then exceeds `most` is left out, smallest first. `isGiven` is one a candidate.
LampGroups groupLamps(std::vector<Candidate> candidates, std::span<const uint8_t> isGiven,
                      size_t most);

/// By what factor rays to a group of `lamps` (>= 1) must be more than those to one.
size_t raysToGroup(size_t lamps);

} // namespace relamp
