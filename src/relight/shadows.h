#pragma once

#include "relight/light_source.h"
#include "relight/obstacles.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"
#include "shading/lamp_sight.h"
#include "shading/seen.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Irradiance from one light at emission 1 on the sides that `sides` name: a few rays each, from
/// `origins` places all over a side.
LampSight directOfSides(const Texels& texels, const Obstacles& obstacles, const LightSource& light,
                        std::span<const Side> sides, size_t origins = 4);

/// What share of a light every texel sees.
///
/// Rays go where the answer changes: a surfel that sees all or nothing, as its neighbours do, needs
/// none. Elsewhere cells of texels look (ShadowLooks), and at an edge every texel for itself, from
/// all over its own area, so that the edge lies between texels as it does in a picture. What then
/// varies from texel to texel no more than so few rays do is smoothed.
class Shadows
{
public:
    /// `coarse[surfel]` is what directOfSides found for its front.
    Shadows(const Texels& texels, const Obstacles& obstacles, const LightSource& light,
            const LampSight& coarse, size_t rays);

    /// Share, 0..1, that texels [begin, begin + count) of a page see. False: none sees anything.
    bool at(size_t page, size_t begin, size_t count, float* share) const;

private:
    /// Shares of some texels, and how far their few rays leave them open.
    struct Moments
    {
        float sum = 0.0f;
        float squares = 0.0f;
        float variance = 0.0f; // sum of the texels' own
        float count = 0.0f;

        void add(float share, float varianceOfIt);
        void add(const Moments& other);
    };
    struct OfPage
    {
        std::vector<uint32_t> firstShare; // of runs; kNone or kAll without shares; empty: all kNone
        std::vector<uint8_t> shares;      // of 255
        std::vector<Moments> moments;     // of runs, until they are smoothed
    };
    static constexpr uint32_t kNone = ~0u;
    static constexpr uint32_t kAll = ~0u - 1;

    [[nodiscard]] OfPage look(size_t page, std::span<const Seen> states, const Obstacles& obstacles,
                              const LightSource& light, size_t rays) const;
    void smooth(std::span<const Seen> states);
    void smoothPage(size_t page, std::span<const Moments> ofSurfels);

    const Texels& texels_;
    std::vector<OfPage> pages_;
};

} // namespace relamp
