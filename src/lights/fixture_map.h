#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/lights.h"
#include "scan/texels.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace relamp
{

/// The burnt-out surface of each fixture, by its number.
using SurfacesOfFixtures = std::map<int, std::vector<ClippedPatch>>;

/// Whose the texels of a page are. `fixtureOf` is one a surfel: whose its burnt-out texels are, a
/// number or FixtureMap::kWall. `isGlowing`, of pixels: what counts as burnt out besides.
FixtureMap fixtureMapOf(const Texels& texels, size_t page, std::span<const int32_t> fixtureOf,
                        const std::vector<bool>& isGlowing = {});

/// SurfelRadiance::isClipped as maps of pages tell it.
PixelMarks burntOutBy(std::span<const FixtureMap> maps);

/// The surfaces that maps of all pages tell. Where a map has another size than its page, the texels
/// of the page look up what lies at their place. A surfel is of the fixture that most of its
/// burnt-out texels are of.
SurfacesOfFixtures surfacesBy(std::span<const FixtureMap> maps, const Texels& texels,
                              const SurfelRadiance& radiance);

} // namespace relamp
