#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "scan/texels.h"

#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// What people and files call a fixture.
struct FixtureLabel
{
    int id = -1;      // none yet
    std::string name; // "ceiling lamp 1"; or none
};

void putLabel(const FixtureLabel& label, Fixture& fixture);

/// Labels for fixtures that were found in a scan: `surfaces` are theirs, one a fixture.
///
/// A fixture's number is that of the burnt-out piece of the scan that it lies on. Pieces are
/// counted on a coarse copy of the texture, those that end sharply first, each from the largest, so
/// that the number does not depend on the quality of the search, its rays or what else it finds;
/// some numbers are nobody's. What is too small for the coarse copy is counted behind, on `texels`.
/// The name is the kind of lamp that stands at such a place of its room,
/// docs/method/fixture_labels.md, and the number. `roomOfSurfel`: empty: there is one room.
std::vector<FixtureLabel> labelsOf(const Texels& texels,
                                   std::span<const std::vector<ClippedPatch>> surfaces,
                                   std::span<const uint8_t> roomOfSurfel, Progress& progress);

} // namespace relamp
