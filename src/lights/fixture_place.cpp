#include "lights/fixture_place.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kSamePlace = 0.02f;   // m; centres are rounded, and scans are read again
constexpr float kOff = 0.25f;         // of its size; it is pointed at by hand
constexpr float kAboutAsLarge = 2.0f; // ratio of areas
constexpr float kFacesAlike = 0.7f;   // of a mean normal, along the fixture's

float reachOf(float area)
{
    return std::max(kOff * std::sqrt(area), kSamePlace);
}

bool mayBe(const PieceOfSurface& piece, const Fixture& fixture)
{
    const float ratio = piece.area / fixture.area;
    const bool facesAlike =
        fixture.normal == glm::vec3(0.0f) || glm::dot(piece.normal, fixture.normal) > kFacesAlike;
    return ratio < kAboutAsLarge && ratio > 1.0f / kAboutAsLarge && facesAlike;
}

} // namespace

PieceOfSurface pieceOf(const Candidate& candidate)
{
    return {candidate.centre, candidate.normal, candidate.area};
}

PieceOfSurface pieceOf(const Fixture& fixture)
{
    return {fixture.centre, fixture.normal, fixture.area};
}

size_t pieceAt(const Fixture& fixture, std::span<const PieceOfSurface> pieces)
{
    size_t nearest = pieces.size();
    float least = reachOf(fixture.area);
    for (size_t p = 0; p < pieces.size(); ++p) {
        const float off = glm::distance(pieces[p].centre, fixture.centre);
        if (off >= least || (off >= kSamePlace && !mayBe(pieces[p], fixture))) continue;
        least = off;
        nearest = p;
    }
    return nearest;
}

bool isMoved(const Fixture& fixture, const PieceOfSurface& own)
{
    return glm::distance(fixture.centre, own.centre) >= reachOf(own.area);
}

} // namespace relamp
