#pragma once

#include "fit/light_model.h"
#include "fit/pieces.h"
#include "fit/sun_rim.h"
#include "lights/surfel_radiance.h"
#include "scan/texels.h"
#include "shading/lit_sides.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What surfels show, one each: of those that are mostly burnt out, these texels; they sent more.
std::vector<glm::vec3> shownOf(const SurfelRadiance& radiance);

/// The light of a room as far as it is known without a sun.
struct LightSoFar
{
    const LitSides& sides;
    std::span<const Piece> pieces;       // those that emit know their `onSides`
    std::span<const uint8_t> emits;      // of pieces
    std::span<const double> cost;        // of pieces, nats that it takes to believe in one
    std::span<const double> log;         // as LightEstimate
    const LightModel& model;             // of these pieces, at:
    std::span<const uint32_t> places;    // surfels
    std::span<const MaterialPair> pairs; // of these
    std::span<const AlikePieces> alike;
    std::span<const MaterialPair> told; // that a person called one paint
    double noise;                       // log: between places of one paint
    double costOfSun;                   // nats that it takes to believe in one, wherever it stands
};

/// A burnt-out piece that is a patch of sun: paint, whose colour is that of what lies beside it.
struct SunPatch
{
    size_t piece = 0;
    glm::vec3 perRadiance{0.0f}; // what it sends on of a sun of radiance 1
};

/// A room with a sun in one direction as one piece more of the light's estimate, the last.
///
/// The light of the sun is what it sends straight, and what the patches send on that it burns out:
/// of these the texture does not tell how much that is.
struct SunTrial
{
    glm::vec3 towards{0.0f}; // unit
    LampSight onSides;
    SunRim rim;
    std::vector<SunPatch> patches;
    LightModel without; // as `with`, but the sun's column is all there is of it: patches are pieces
    LightModel with;    // what is a patch of sun does nothing by itself

    SunTrial(const Texels& texels, const SurfelRadiance& radiance, const LightSoFar& light,
             glm::vec3 direction, LampSight seen);

    /// Pairs across the rim, each cell of it as much as one of the independent ones that all
    /// `drawn` pairs are worth.
    [[nodiscard]] std::vector<MaterialPair> pairs(size_t drawn) const;
    /// `with` as one channel sees it: patches have colours.
    [[nodiscard]] LightModel channelOf(int channel) const;
    [[nodiscard]] size_t sun() const { return without.pieces - 1; }

private:
    std::vector<DirectLight>& addRow(glm::vec3 shown, glm::vec3 gathered, float ofSun);
    void copyRow(const LightModel& before, size_t row, float ofSun);
    void addRows(const SurfelRadiance& radiance, const Surfels& surfels, const LightSoFar& light);
    void addRim(const SurfelRadiance& radiance, const Surfels& surfels, const LightSoFar& light);
    [[nodiscard]] glm::vec3 paintBeside(const Piece& piece, const LightSoFar& light) const;
    void findPatches(const LightSoFar& light);
    void setChannel(LightModel& model, int channel) const;

    std::vector<float> straight_; // of the sun, at rows of a model
    size_t firstOfRim_ = 0;
};

} // namespace relamp
