#pragma once

#include "scan/texels.h"

namespace relamp
{

/// Places all over the texels of a page, not in their middle alone. `texels` must outlive this.
/// Thread safe.
class Footprints
{
public:
    Footprints(const Texels& texels, size_t page);

    /// A place within a texel, `u` in its unit square. A vertex that stands for a texel is a point.
    [[nodiscard]] TexelSite at(size_t texel, glm::vec2 u) const;
    /// Of the patterns that rays from them follow.
    [[nodiscard]] uint32_t seed() const { return texels_.surfels.seed; }

private:
    const Texels& texels_;
    const PageTexels& page_;
    uint32_t width_;
    bool isSpread_;
};

} // namespace relamp
