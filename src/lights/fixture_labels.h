#pragma once

#include "lights/candidates.h"
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

/// Between which 98 % of the surface of a room lie, world y in m.
struct RoomHeights
{
    float floor = 0.0f;
    float ceiling = 0.0f;
};

/// The burnt-out pieces of a coarse copy of the texture: what fixtures are numbered by, so that the
/// number does not depend on the quality of the search, its rays or what else it finds. Pieces that
/// end sharply come first, each part from the largest.
///
/// Of the scan alone, and as large as the scan while it is made: so before rays are cast.
struct CoarsePieces
{
    std::vector<Candidate> pieces;
    RoomHeights heights;     // of the whole scan
    float surfelSize = 0.0f; // m
};

CoarsePieces coarsePiecesOf(const Texels& texels, Progress& progress);

/// Labels for fixtures that were found in a scan: `surfaces` are theirs, one a fixture.
///
/// A fixture's number is that of the piece of `coarse` that it lies on; some numbers are nobody's.
/// What is too small for the coarse copy is counted behind, on `texels`. The name is the kind of
/// lamp that stands at such a place of its room, docs/method/fixture_labels.md, and the number.
/// `roomOfSurfel`: empty: there is one room.
std::vector<FixtureLabel> labelsOf(const Texels& texels, const CoarsePieces& coarse,
                                   std::span<const std::vector<ClippedPatch>> surfaces,
                                   std::span<const uint8_t> roomOfSurfel, Progress& progress);

} // namespace relamp
