#pragma once

#include "relamp/inspect.h"
#include "scan/facets.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

namespace relamp
{

struct Texels;

/// How the places that share a texel are to each other; of several, the greatest counts.
enum class OverlapKind : uint8_t {
    alike,    // two surfaces close to each other that face alike: both get the same light
    opposite, // two surfaces close to each other that face apart
    copied,   // two charts lie on the same part of the texture
    mirrored, // likewise, one of them turned over
    tiled     // the texture starts anew beyond its edge
};
constexpr size_t kOverlapKinds = 5;

// Share of a page's texels up to which overlap is nothing but rounding at seams.
constexpr double kSeams = 1e-3;

/// Of facets `a` and `b`, which both show `pixel`. `isSameTile`: both lie in the same tile of the
/// plane that the page repeats over.
OverlapKind overlapKindOf(const Facet& a, const Facet& b, glm::vec2 pixel, bool isSameTile);

/// Whether of two surfaces that are alike `b` is the one that is seen.
bool isBefore(const Facet& a, const Facet& b, glm::vec2 pixel);

/// What is to be said of it; none where it is next to nothing.
std::optional<std::string> noteOn(const Overlap& overlap);

/// Throws Error(unsupported), naming share, kind and meshes, where so many texels stand for places
/// far apart that they spoil the room; unless ScanOptions::allowOverlap.
void checkOverlap(const Texels& texels);
/// Whether that would be so.
bool spoils(const Overlap& overlap);

} // namespace relamp
