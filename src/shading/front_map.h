#pragma once

#include "shading/hit_lists.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relamp
{

/// The fronts that a page shows, by squares of `side` pixels: what its middle one does, or nothing
/// where there is no texel. Many threads may put pixels at once, each its own.
class FrontMap
{
public:
    FrontMap(uint32_t width, uint32_t height, uint32_t side)
        : side_(side), width_(width), columns_((width + side - 1) / side),
          fronts_(size_t{columns_} * ((height + side - 1) / side), HitTarget::nothing())
    {}

    /// `pixel` = row * width + column.
    [[nodiscard]] HitTarget at(uint32_t pixel) const { return fronts_[squareOf(pixel)]; }
    void put(uint32_t pixel, HitTarget target)
    {
        if (side_ == 1 ||
            (pixel % width_ % side_ == side_ / 2 && pixel / width_ % side_ == side_ / 2))
            fronts_[squareOf(pixel)] = target;
    }

private:
    [[nodiscard]] size_t squareOf(uint32_t pixel) const
    {
        if (side_ == 1) return pixel;
        return size_t{pixel / width_ / side_} * columns_ + pixel % width_ / side_;
    }

    uint32_t side_;
    uint32_t width_;   // pixels
    uint32_t columns_; // squares
    std::vector<HitTarget> fronts_;
};

} // namespace relamp
