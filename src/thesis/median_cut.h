#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Something that a cut is made through: a place and how much energy there is.
struct CutPoint
{
    glm::vec3 position{0.0f};
    float energy = 0.0f; // > 0
};

/// Median cut (Debevec, "A Median Cut Algorithm for Light Probe Sampling", SIGGRAPH 2005) in space.
///
/// Halves the energy `levels` times: every region is split across the longest side of its box,
/// where the energy on both sides is nearest to equal. Returns the regions as lists of indices into
/// `points`, at most 2^levels of them; a region of a single point is not split further. Regions are
/// in the order of the cuts, lower side first.
std::vector<std::vector<uint32_t>> medianCut(std::span<const CutPoint> points, int levels);

} // namespace relamp
