#pragma once

#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace relamp
{

/// For each of some receivers, what its rays met, each as likely: indices of radiances.
struct SightLists
{
    std::vector<uint32_t> first{0}; // of receivers, and one more: where their targets begin
    std::vector<uint32_t> target;

    [[nodiscard]] size_t count() const { return first.size() - 1; }
    /// Irradiance on every receiver: pi times the mean of the radiances that it sees; by every
    /// `step`-th of its rays, which are in the order of space and so an even choice.
    void gather(std::span<const glm::vec4> radiance, std::span<glm::vec4> irradiance,
                size_t step = 1) const;
};

/// What of a room decides how light goes about in it, whatever the light: who sees whom. Found
/// once, kept in a file.
///
/// Light bounces between clusters: surfel sides of one place and orientation, some 2 x 2. Its last
/// two ways are from the sides themselves to the fronts of surfels, so that what lies next to each
/// other is told apart.
struct Transport
{
    std::vector<Side> sides;         // whose light is followed; fronts first: that of surfel s is s
    std::vector<uint32_t> clusterOf; // of sides
    std::vector<float> weight;       // of sides: share in their cluster as others see it, sums to 1
    SightLists ofFronts;             // receivers are surfels; radiances those of sides and sky
    SightLists ofClusters;           // of clusters and sky

    [[nodiscard]] size_t clusters() const { return ofClusters.count(); }
    /// How many radiances there are beside the sides' or clusters' own, behind them: SkyBins, and
    /// nothing.
    [[nodiscard]] static size_t radiancesBeyond();
};

/// Joins the sides that hit lists know into clusters and looks up what every ray met.
Transport transportOf(const Texels& texels, const HitLists& hits);

} // namespace relamp
