#pragma once

#include "lights/candidates.h"
#include "relamp/lights.h"

#include <cstddef>
#include <span>

namespace relamp
{

/// A piece of surface that a fixture may be; the normal need not be a unit.
struct PieceOfSurface
{
    glm::vec3 centre{0.0f}; // world, m
    glm::vec3 normal{0.0f}; // mean
    float area = 0.0f;      // m^2
};

PieceOfSurface pieceOf(const Candidate& candidate);
PieceOfSurface pieceOf(const Fixture& fixture);

/// The piece that a fixture without a number means by where it stands, as those of relamp 0.1 are;
/// pieces.size() where there is none. It is the nearest whose centre is within 2 cm; else within a
/// quarter of the fixture's size, half to twice as large and facing alike. This is the only place
/// where lamps are known by their places.
size_t pieceAt(const Fixture& fixture, std::span<const PieceOfSurface> pieces);

/// Whether a person has put a fixture elsewhere than the surface that has its number: farther than
/// pieceAt() would look.
bool isMoved(const Fixture& fixture, const PieceOfSurface& own);

} // namespace relamp
