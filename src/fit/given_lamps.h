#pragma once

#include "fit/lamps.h"
#include "lights/candidates.h"
#include "lights/fixture_map.h"
#include "relamp/lights.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// Where the surfaces of a room's fixtures are known from.
struct KnownSurfaces
{
    SurfacesOfFixtures byNumber;                      // as a result's fixtures.png tells them
    std::function<std::vector<Candidate>()> burntOut; // pieces that nobody named, or null: none;
                                                      // asked for where a number says nothing
};

/// The surface of each of a list of fixtures.
///
/// That of its number, with the far side mirrored where the fixture has one. Else, where a fixture
/// has no number or nothing is known by it, the burnt-out piece at its place (pieceAt). Else, and
/// where a person has moved it, a disc of its area that faces along its normal, or a ball without
/// one. `notes` receives a sentence where numbers did not do.
std::vector<std::vector<ClippedPatch>> surfacesOf(std::span<const Fixture> fixtures,
                                                  const KnownSurfaces& known, const Texels& texels,
                                                  const RayScene& scene,
                                                  std::vector<std::string>& notes);

/// A disc, or a ball, of a fixture's area.
std::vector<ClippedPatch> bodyOf(const Fixture& fixture);

/// The lamps of a lights file. `surfaces` are its fixtures', as surfacesOf() finds them. A point
/// light of no fixture is a ball of its radius. What is dark is left out. Fixtures of one group and
/// radiance are one FoundLamp.
FoundLamps asGiven(const Lights& given, std::span<const std::vector<ClippedPatch>> surfaces);

} // namespace relamp
