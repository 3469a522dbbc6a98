#pragma once

#include "relamp/lights.h"
#include "scan/pixel_marks.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Texels that are a lamp's though they are not burnt out.
struct GlowMarks
{
    PixelMarks isGlowing; // empty: there are none

    [[nodiscard]] bool areNone() const { return isGlowing.empty(); }
};

/// Those that show at least the luminance `from` of their surfel, infinity where it is none's.
/// `linearization`: null, there is none.
GlowMarks glowingFrom(const Texels& texels, std::span<const float> from,
                      const Linearization* linearization);

/// Those that maps of all pages call a fixture's. A map of another size than its page tells of
/// none.
GlowMarks glowingBy(std::span<const FixtureMap> maps,
                    std::span<const std::vector<bool>> isBurntOut);

/// What counts as burnt out with them: SurfelRadiance::isClipped.
PixelMarks withGlowing(PixelMarks isBurntOut, const GlowMarks& marks);

/// The other way round: the luminance of each surfel that its marked texels, and none that is
/// darker, reach; infinity where none is marked. Empty where there are no marks.
std::vector<float> leastOfGlowing(const Texels& texels, const GlowMarks& marks,
                                  const Linearization* linearization);

} // namespace relamp
