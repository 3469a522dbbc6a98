#include "fit/sun_trial.h"

#include "base/radiometry.shared.h"
#include "fit/light_fit.h"
#include "image/burnt_out.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kMostly = 0.8f; // of a piece's area that the sun reaches: of half a lampshade it
                                // reaches 0.64 at most

/// Mean over a surfel and its neighbours: of light that changes slowly, its own few rays are noise.
template<class T, class Of>
T meanAround(const Surfels& surfels, uint32_t surfel, const Of& of)
{
    const std::span around = surfels.neighborsOf(surfel);
    T sum{0.0f};
    for (const uint32_t n : around) sum += of(n);
    return sum / static_cast<float>(around.size());
}

/// Area of a piece of which `of` tells how much.
template<class Of>
float areaOf(const Piece& piece, const Of& of)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : piece.candidate.patches)
        if (patch.surfel != Surfels::kNone) area += patch.area * of(patch.surfel);
    return area;
}

} // namespace

std::vector<glm::vec3> shownOf(const SurfelRadiance& radiance)
{
    std::vector<glm::vec3> shown = radiance.plain;
    for (const ClippedPatch& patch : radiance.clipped)
        if (isMostlyBurntOut(radiance, patch.surfel)) shown[patch.surfel] = patch.radiance;
    return shown;
}

SunTrial::SunTrial(const Texels& texels, const SurfelRadiance& radiance, const LightSoFar& light,
                   glm::vec3 direction, LampSight seen)
    : towards(direction), onSides(std::move(seen)), rim(texels, radiance, onSides)
{
    addRows(radiance, texels.surfels, light);
    setChannel(without, -1);
    findPatches(light);
    with = without;
    std::vector<uint8_t> isPatch(with.pieces, 0);
    for (const SunPatch& patch : patches) {
        with.area[patch.piece] = 0.0f;
        isPatch[patch.piece] = 1;
    }
    for (std::vector<DirectLight>& ofPlace : with.direct)
        std::erase_if(ofPlace, [&](DirectLight sent) { return isPatch[sent.piece] != 0; });
    setChannel(with, -1);
}

/// Without light from outside.
std::vector<DirectLight>& SunTrial::addRow(glm::vec3 shown, glm::vec3 gathered, float ofSun)
{
    without.shown.push_back(shown);
    without.gathered.push_back(gathered);
    without.missed.emplace_back();
    straight_.push_back(ofSun);
    return without.direct.emplace_back();
}

void SunTrial::copyRow(const LightModel& before, size_t row, float ofSun)
{
    addRow(before.shown[row], before.gathered[row], ofSun) = before.direct[row];
    without.missed.back() = before.missed[row];
}

/// Rows of the rim come behind the places, a column and a row for the sun come last.
void SunTrial::addRows(const SurfelRadiance& radiance, const Surfels& surfels,
                       const LightSoFar& light)
{
    const LightModel& before = light.model;
    without.pieces = before.pieces + 1;
    without.outsides = before.outsides;
    without.roomsOfHoles = before.roomsOfHoles;
    without.area = before.area;
    without.area.push_back(0.0f);
    without.coloured = before.coloured;
    without.coloured.resize(without.pieces, 0.0f); // it may be empty
    without.fades = before.fades;
    without.fades.resize(without.pieces, 0); // likewise
    for (size_t i = 0; i < before.places(); ++i)
        copyRow(before, i, onSides[light.places[i]].visible);
    addRim(radiance, surfels, light);
    for (size_t f = 0; f < before.pieces; ++f) {
        const Piece& piece = light.pieces[f];
        const float lit = areaOf(piece, [&](uint32_t s) { return onSides[s].visible; });
        copyRow(before, before.placeOf(f), lit / std::max(piece.candidate.area, 1e-9f));
    }
    addRow(glm::vec3(0.0f), glm::vec3(0.0f), 0.0f);
}

/// What comes from outside is gathered there as it was last.
void SunTrial::addRim(const SurfelRadiance& radiance, const Surfels& surfels,
                      const LightSoFar& light)
{
    const Gathered& gathered = light.sides.gathered;
    const std::vector<glm::vec3> shown = shownOf(radiance);
    firstOfRim_ = light.model.places();
    for (const uint32_t s : rim.surfels()) {
        std::vector<DirectLight>& row = addRow(
            shown[s],
            meanAround<glm::vec3>(surfels, s, [&](uint32_t n) { return gathered.irradiance[n]; }),
            onSides[s].visible);
        for (uint32_t f = 0; f < light.pieces.size(); ++f) {
            if (light.emits[f] == 0) continue;
            const auto mean = meanAround<float>(
                surfels, s, [&](uint32_t n) { return light.pieces[f].onSides[n].visible; });
            if (mean > 0.0f) row.push_back({f, mean});
        }
    }
}

/// Albedo across the rim from a piece; where it has no rim, across all of it.
glm::vec3 SunTrial::paintBeside(const Piece& piece, const LightSoFar& light) const
{
    std::vector<uint8_t> isOfPiece(light.sides.albedo.size(), 0);
    for (const ClippedPatch& patch : piece.candidate.patches)
        if (patch.surfel != Surfels::kNone) isOfPiece[patch.surfel] = 1;
    glm::vec3 sum(0.0f);
    glm::vec3 sumOfAll(0.0f);
    float count = 0.0f;
    const std::vector<MaterialPair> across = rim.all();
    for (const auto& [lit, dark] : across) {
        sumOfAll += light.sides.albedo[dark];
        if (isOfPiece[lit] == 0) continue;
        sum += light.sides.albedo[dark];
        count += 1.0f;
    }
    if (count > 0.0f) return sum / count;
    return sumOfAll / std::max(static_cast<float>(across.size()), 1.0f);
}

void SunTrial::findPatches(const LightSoFar& light)
{
    for (size_t f = 0; f < light.pieces.size(); ++f) {
        const Piece& piece = light.pieces[f];
        const float lit = areaOf(piece, [&](uint32_t s) {
            return onSides[s].open > 0.0f ? onSides[s].visible / onSides[s].open : 0.0f;
        });
        if (lit < kMostly * piece.candidate.area) continue;
        patches.push_back({f, paintBeside(piece, light) / kPi * straight_[without.placeOf(f)]});
    }
}

/// Where one channel alone is burnt out, the others are as seen, and so is most of the luminance.
void SunTrial::setChannel(LightModel& model, int channel) const
{
    const auto pick = [&](glm::vec3 rgb) { return channel < 0 ? luminance(rgb) : rgb[channel]; };
    model.isBurntOut.assign(model.places(), 0);
    for (size_t i = firstOfRim_; i < model.places(); ++i)
        model.isBurntOut[i] = pick(model.shown[i]) >= kSafelyBelow ? 1 : 0;
    for (size_t i = 0; i < model.shown.size(); ++i) {
        float ofSun = straight_[i];
        for (const SunPatch& patch : patches)
            ofSun += pick(patch.perRadiance) * without.directAt(i, patch.piece);
        std::vector<DirectLight>& ofPlace = model.direct[i];
        if (!ofPlace.empty() && ofPlace.back().piece == sun()) ofPlace.pop_back();
        if (ofSun > 0.0f) ofPlace.push_back({static_cast<uint32_t>(sun()), ofSun});
    }
}

std::vector<MaterialPair> SunTrial::pairs(size_t drawn) const
{
    const double perCell = static_cast<double>(drawn) / LightFit::effectivePairs(with);
    return rim.pairs(static_cast<size_t>(std::ceil(perCell)), static_cast<uint32_t>(firstOfRim_));
}

LightModel SunTrial::channelOf(int channel) const
{
    LightModel model = with;
    setChannel(model, channel);
    return model;
}

} // namespace relamp
