#pragma once

#include "fit/light_model.h"
#include "lights/area_light.h"
#include "lights/candidates.h"
#include "scan/rays.h"
#include "shading/lamp_sight.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A burnt-out piece of surface that may emit, with what it does at all places at radiance 1.
struct Piece
{
    Candidate candidate;
    std::vector<uint32_t> ends{}; // see LampGroup; empty: it is one lamp
    bool isGiven = false;         // a person says that it shines
    size_t body = 0;              // of the same number: two sides of one lamp
    bool isUnseen = false;        // its far side, not scanned
    bool isOpening = false;       // nothing that was scanned: see HitLists::squares
    bool isFading = false;        // as overexposed walls are: fades()
    LampSight direct{};           // what places see of it
    LampSight onSides{};          // likewise hit lists
    glm::vec3 radiance{1.0f};
    float error = 0.0f; // standard error of log radiance

    [[nodiscard]] size_t rays() const; // to it from an origin, at least 1
};

/// What pieces are to each other.
struct Kinship
{
    std::vector<AlikePieces> alike;             // they have about one radiance
    std::vector<std::vector<uint32_t>> model;   // of each, others that look like it
    std::vector<std::vector<uint32_t>> leansOn; // of each, larger ones that it may be a part of:
                                                // the near side of a far one, a pane beside a pane
};

Kinship kinshipOf(const std::vector<Piece>& pieces, const RayScene& scene);

/// Makes one of pieces that touch and are about equally bright, of a lamp and a sliver beside it,
/// and of two sides.
void joinPieces(std::vector<Piece>& pieces);

} // namespace relamp
