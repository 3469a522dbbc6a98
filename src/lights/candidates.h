#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/scan.h"
#include "scan/texels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

constexpr float kSameFacing = 0.8f; // cosine between normals of one surface, with a scan's noise
constexpr float kSamePlane = 0.97f; // cosine between normals on one plane
constexpr float kTouching = 0.12f;  // m between pieces of one lamp
constexpr float kSpeck = 0.02f;     // m^2; of less little hangs
constexpr float kPaneArea = 0.1f;   // m^2; a plane from here on may be a pane
constexpr float kCrumb = 0.005f;    // m^2; of less a scan does not tell the shape
constexpr float kScanError = 0.02f; // m; how far its worst 5 % lie off the room's surfaces

/// A connected, burnt-out piece of surface that may be a lamp, or a wall that a lamp shines on.
struct Candidate
{
    std::vector<ClippedPatch> patches;
    glm::vec3 centre{0.0f}; // world, mean by area
    glm::vec3 normal{
        0.0f};         // mean by area, not unit: its length is 1 for a plane, near 0 for a globe
    float area = 0.0f; // m^2
};

/// Patches as one piece; without any, it has no area.
Candidate candidateOf(std::vector<ClippedPatch> patches);

/// Whether it faces one way, as a panel does.
bool isFlat(const Candidate& candidate);

/// Standard error of the logarithm of a lamp's area (m^2): its rim is off by as much as a scan is.
/// Of kScanError's 5 % that is half.
float errorOfArea(float area);

/// Cuts what is burnt out into pieces along edges and level changes of the surface, largest first.
///
/// A lamp on a wall that it burns out is one blob in the texture; in space it stands off the wall,
/// so large planes are cut from what rises over them. Specks in a surface that is nearly as bright
/// around them are no lamps and are left out.
std::vector<Candidate> findCandidates(const Texels& texels, const SurfelRadiance& radiance);

/// Whether the surface goes on around it, nearly burnt out itself: overexposure fades, where a lamp
/// ends sharply.
bool fades(const Texels& texels, const SurfelRadiance& radiance, const Candidate& candidate);

/// Share of its area that some channel is not burnt out in: that channel was seen as it is.
float colouredShare(const Candidate& candidate);

inline constexpr float kPointedAt = 0.3f; // m around a place that a person names

/// The candidate that a person points at: the one with the patch nearest to `place`, within that;
/// candidates.size() where there is none.
size_t nearestTo(std::span<const Candidate> candidates, glm::vec3 place);

/// The box around its patches and so much more on all sides; nothing is in that of none.
Bounds boundsAround(const Candidate& candidate, float reach);

/// Whether some patches of both are less than `reach` metres apart.
bool areWithin(const Candidate& a, const Candidate& b, float reach);

/// Whether they are as near to each other as pieces of one lamp.
bool areTouching(const Candidate& a, const Candidate& b);

} // namespace relamp
