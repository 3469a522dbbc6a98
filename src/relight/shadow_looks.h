#pragma once

#include "relight/light_source.h"
#include "relight/obstacles.h"
#include "relight/shadow_cells.h"
#include "scan/footprints.h"
#include "shading/seen.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Of a light, what a texel sees.
struct TexelShare
{
    float share = 0.0f; // 0..1
    float rays = 0.0f;  // that it is as sure as; 0: it faces away
};

/// Looks of cells of texels at a light.
///
/// Every cell casts a few rays from all over its texels, and all of its rays where those of a
/// surfel do not agree: a cell's own few often agree by chance in a penumbra, and it would be too
/// bright or too dark. What its texels see is interpolated between cells. Where cells beside each
/// other differ much, or at all if the light is a point, an edge may be narrower than cells are,
/// and their texels look for themselves.
class ShadowLooks
{
public:
    /// All must outlive this.
    ShadowLooks(const Texels& texels, size_t page, const ShadowCells& cells,
                const Obstacles& obstacles, const LightSource& light, size_t rays);

    /// Of each texel of a cell, in its order. Thread safe.
    void sharesOf(size_t cell, std::vector<TexelShare>& shares) const;

private:
    class Batch;

    [[nodiscard]] size_t raysOf(size_t cell) const;
    [[nodiscard]] bool findEdge(size_t cell) const;
    [[nodiscard]] TexelShare ownShare(size_t cell) const;
    void lookThemselves(size_t cell, std::span<TexelShare> shares) const;
    [[nodiscard]] TexelShare interpolated(size_t cell, const ShadowCells::Texel& texel) const;

    Footprints prints_;
    const ShadowCells& cells_;
    const Obstacles& obstacles_;
    const LightSource& light_;
    size_t few_;
    size_t rays_;
    std::vector<AreaSample> sums_; // of cells
    std::vector<uint8_t> met_;     // of the page's runs: what the first rays of their cells met
    std::vector<uint8_t> isEdge_;  // of cells
};

} // namespace relamp
