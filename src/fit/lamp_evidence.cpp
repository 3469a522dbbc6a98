#include "fit/lamp_evidence.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/camera_columns.h"
#include "fit/pairs.h"
#include "scan/gain.h"
#include "scan/linearization.h"
#include "shading/direct_sum.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

// Numerics.
constexpr double kPlacesOfRoom = 3000.0; // of fewer, noise of their few rays is evidence, too
constexpr size_t kEvidencePlaces = 6000; // all over a room, so that a small lamp lights a dozen
constexpr size_t kPlacesOfDraft = 2000;  // likewise, for a first look
constexpr size_t kPlacesOfScout = 4; // of a house; in one room a small lamp has few places to lose
constexpr size_t kLooksAcross = 2;   // of a wall's place for each of its pairs: half disagree
constexpr size_t kLooks = 12;        // from a piece, at the others
constexpr size_t kRaysToSettle = 2;  // to a lamp at most, for what walls send on of it
constexpr float kAreaOfRay = 0.05f;  // m^2 of a piece that a ray from an origin is for

std::vector<SoughtLamp> soughtOf(std::span<const Piece> pieces, size_t fewestRays,
                                 size_t mostRays = LampEvidence::kMostRays)
{
    std::vector<SoughtLamp> lamps;
    for (const Piece& piece : pieces) {
        const size_t rays =
            piece.isOpening ? 1 : static_cast<size_t>(piece.candidate.area / kAreaOfRay);
        lamps.push_back({AreaLight(piece.candidate.patches),
                         std::clamp(rays, fewestRays, mostRays) * piece.rays()});
    }
    return lamps;
}

/// Calls `visit(surfel)` for those around a place that bounce light is averaged over.
template<class Visit>
void forEachAround(const Surfels& surfels, uint32_t place, const Visit& visit)
{
    for (const uint32_t n : surfels.neighborsOf(place))
        if (surfels.areBeside(place, n)) visit(n);
}

/// Fronts of some of a piece's surfels, evenly.
std::vector<uint32_t> looksFrom(const Piece& piece)
{
    std::vector<uint32_t> lists;
    for (const ClippedPatch& patch : piece.candidate.patches)
        if (patch.surfel != Surfels::kNone) lists.push_back(patch.surfel);
    const size_t looks = std::min(kLooks, lists.size());
    for (size_t k = 0; k < looks; ++k) lists[k] = lists[k * lists.size() / looks];
    lists.resize(looks);
    return lists;
}

} // namespace

std::vector<uint32_t> placesToLookAt(const Surfels& surfels, const SurfelRadiance& radiance,
                                     Quality quality, double rooms)
{
    std::vector<uint32_t> good;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (radiance.plainArea[s] > 0.0f && radiance.clippedArea[s] < 0.02f * radiance.plainArea[s])
            good.push_back(s);
    const size_t ofRoom = quality == Quality::draft ? kPlacesOfDraft : kEvidencePlaces;
    const auto most = static_cast<size_t>(static_cast<double>(ofRoom) * rooms);
    std::vector<uint32_t> places(std::min(most, good.size()));
    for (size_t i = 0; i < places.size(); ++i) places[i] = good[i * good.size() / places.size()];
    return places;
}

LampEvidence::LampEvidence(const Texels& texels, const RayScene& scene, const HitLists& hits,
                           SurfelRadiance radiance, Quality quality, double rooms,
                           std::span<const MaterialPair> told)
    : texels_(texels), scene_(scene), hits_(hits), radiance_(std::move(radiance)),
      textureOfAll_(radiance_.plain), field_(fieldOf(radiance_))
{
    for (const uint32_t place : placesToLookAt(texels.surfels, radiance_, quality, rooms))
        addPlace(place);
    for (const ClippedPatch& patch : radiance_.clipped) textureOfClipped_.push_back(patch.radiance);
    drawn_ = places_.size();
    rooms_ = std::clamp(static_cast<double>(drawn_) / kPlacesOfRoom, 1.0, rooms);
    for (const auto& [p, q] : told) told_.push_back({addPlace(p), addPlace(q)});
    numberRooms();
    findAround();
}

uint32_t LampEvidence::addPlace(uint32_t surfel)
{
    places_.push_back(surfel);
    texture_.push_back(radiance_.plain[surfel]);
    positions_.push_back(texels_.surfels.position[surfel]);
    return static_cast<uint32_t>(places_.size() - 1);
}

/// Of rooms that have places alone.
void LampEvidence::numberRooms()
{
    if (hits_.roomOfSurfel.empty()) return;
    std::map<uint8_t, uint8_t> numbers;
    for (const uint32_t place : places_) numbers[hits_.roomOfSurfel[place]] = 0;
    uint8_t next = 0;
    for (auto& [room, number] : numbers) number = next++;
    for (const uint32_t place : places_) roomOfPlace_.push_back(numbers[hits_.roomOfSurfel[place]]);
}

void LampEvidence::findAround()
{
    placeInAround_.assign(texels_.surfels.count(), 0);
    for (const uint32_t place : places_)
        forEachAround(texels_.surfels, place, [&](uint32_t n) { placeInAround_[n] = 1; });
    for (uint32_t s = 0; s < placeInAround_.size(); ++s) {
        if (placeInAround_[s] == 0) continue;
        placeInAround_[s] = static_cast<uint32_t>(around_.size());
        around_.push_back(s);
    }
    missed_.resize(places_.size());
    forEach(places_.size(), [&](size_t i) {
        float count = 0.0f;
        forEachAround(texels_.surfels, places_[i], [&](uint32_t n) {
            addMissed(missedOf(hits_, n), 1.0f, missed_[i]); // a front's list is its surfel's
            count += 1.0f;
        });
        for (MissedLight& missed : missed_[i]) missed.irradiance /= count;
    });
    settling_ = SettlingGather(hits_, field_, around_);
}

double LampEvidence::meanLogOfPlaces() const
{
    double sum = 0.0;
    for (const uint32_t place : places_)
        sum += std::log(std::max(static_cast<double>(luminance(radiance_.plain[place])),
                                 static_cast<double>(kFaintest)));
    return sum / static_cast<double>(std::max<size_t>(places_.size(), 1));
}

double LampEvidence::linearize(const CameraModel& camera)
{
    const double before = meanLogOfPlaces();
    const Linearization linearization =
        linearizationOf(camera, texels_.surfels, hits_.roomOfSurfel);
    forEach(textureOfAll_.size(), [&](size_t s) {
        glm::vec3& radiance = radiance_.plain[s];
        for (int c = 0; c < 3; ++c) radiance[c] = linearization.response(textureOfAll_[s][c]);
        radiance *= linearization.whiteOf(s);
    });
    for (size_t i = 0; i < textureOfClipped_.size(); ++i) {
        ClippedPatch& patch = radiance_.clipped[i];
        for (int c = 0; c < 3; ++c)
            patch.radiance[c] = linearization.response(textureOfClipped_[i][c]);
        patch.radiance *= linearization.whiteOf(patch.surfel);
    }
    radiance_.white = linearization.perGain;
    field_.plain = radiance_.plain;
    settling_.takePlain(hits_, field_, around_);
    return meanLogOfPlaces() - before;
}

Gain LampEvidence::brightnessAround(const Response& response) const
{
    std::vector<float> log(textureOfAll_.size());
    std::vector<float> area(textureOfAll_.size());
    forEach(log.size(), [&](size_t s) {
        glm::vec3 radiance = textureOfAll_[s];
        for (int c = 0; c < 3; ++c) radiance[c] = response(radiance[c]);
        log[s] = std::log(std::max(luminance(radiance), kDarkestBase));
        area[s] = radiance_.plainArea[s] + radiance_.clippedArea[s];
    });
    const double all = std::accumulate(area.begin(), area.end(), 0.0);
    const double sum = std::inner_product(log.begin(), log.end(), area.begin(), 0.0);
    for (float& l : log) l -= static_cast<float>(sum / std::max(all, 1e-30));
    const std::span<const glm::vec3> positions = texels_.surfels.position;
    return meansOver(toneLatticeOver(positions), positions, log, area);
}

void LampEvidence::drawAllPairs()
{
    for (const size_t perPlace : {kPairsFirst, kPairs})
        pairs_[perPlace] =
            drawPairs(std::span(texture_).first(drawn_), std::span(places_).first(drawn_),
                      texels_.surfels, scene_, perPlace, roomOfPlace_);
}

void LampEvidence::pairWalls(std::span<const glm::vec3> albedo)
{
    for (const size_t perPlace : {kPairsFirst, kPairs})
        addPairs(perPlace, drawAcrossWalls(albedo.first(drawn_), std::span(places_).first(drawn_),
                                           texels_.surfels, kLooksAcross * perPlace, roomOfPlace_));
}

std::span<const MaterialPair> LampEvidence::pairs(size_t perPlace) const
{
    return pairs_.at(perPlace);
}

void LampEvidence::look(std::span<Piece> pieces, size_t fewestRays) const
{
    std::vector<LampSight> seen =
        directOfLists(texels_, scene_, hits_, soughtOf(pieces, fewestRays), places_,
                      rooms_ > 1.0 ? kPlacesOfScout : 1);
    for (size_t f = 0; f < pieces.size(); ++f) pieces[f].direct = std::move(seen[f]);
}

LightModel LampEvidence::modelOf(std::span<const Piece> pieces, const PieceSights& sights,
                                 std::vector<std::vector<DirectLight>> direct)
{
    std::fill(field_.shines.begin(), field_.shines.end(), uint8_t{0});
    for (const Piece& piece : pieces)
        for (const ClippedPatch& patch : piece.candidate.patches)
            if (patch.surfel != Surfels::kNone) field_.shines[patch.surfel] = 1;
    LightModel model{.pieces = pieces.size(),
                     .outsides = hits_.shareOfPart.size(),
                     .roomsOfHoles = hits_.rooms,
                     .rooms = rooms_};
    const size_t rows = places_.size() + pieces.size();
    model.shown.resize(rows, glm::vec3(0.0f));
    model.gathered.resize(rows, glm::vec3(0.0f));
    model.missed = missed_;
    model.missed.resize(rows);
    const bool isNew = direct.empty();
    model.direct = std::move(direct);
    model.direct.resize(rows);
    const Gathered gathered = settling_.gather(field_);
    forEach(places_.size(), [&](size_t i) {
        float count = 0.0f; // around it: bounce light changes slowly, its few rays are noisy
        forEachAround(texels_.surfels, places_[i], [&](uint32_t n) {
            model.gathered[i] += gathered.irradiance[placeInAround_[n]];
            count += 1.0f;
        });
        model.gathered[i] /= count;
        model.shown[i] = field_.plain[places_[i]];
    });
    forEachChunk(isNew ? places_.size() : 0, LampSight::kBlock, [&](size_t begin, size_t) {
        for (uint32_t f = 0; f < pieces.size(); ++f)
            pieces[f].direct.forEachOf(begin / LampSight::kBlock, [&](size_t i, AreaSample seen) {
                if (seen.visible > 0.0f) model.direct[i].push_back({f, seen.visible});
            });
    });
    addLightOnPieces(pieces, sights, model);
    return model;
}

PieceSights LampEvidence::sightsOf(std::span<const Piece> pieces) const
{
    PieceSights sights;
    for (const Piece& piece : pieces) {
        const std::vector<uint32_t> looks = looksFrom(piece);
        sights.lists.insert(sights.lists.end(), looks.begin(), looks.end());
        sights.first.push_back(sights.lists.size());
    }
    sights.direct.resize(pieces.size());
    if (sights.lists.empty()) return sights;
    const auto light = directOfLists(texels_, scene_, hits_, soughtOf(pieces, 1), sights.lists);
    for (size_t f = 0; f < pieces.size(); ++f)
        for (uint32_t other = 0; other < pieces.size(); ++other) {
            if (pieces[other].body == pieces[f].body) continue;
            float sum = 0.0f;
            for (size_t k = sights.first[f]; k < sights.first[f + 1]; ++k)
                sum += light[other][k].visible;
            const auto looks = static_cast<float>(sights.first[f + 1] - sights.first[f]);
            if (sum > 0.0f) sights.direct[f].push_back({other, sum / looks});
        }
    return sights;
}

/// Means over some looks from each piece.
void LampEvidence::addLightOnPieces(std::span<const Piece> pieces, const PieceSights& sights,
                                    LightModel& model) const
{
    model.area.assign(pieces.size(), 0.0f);
    model.coloured.assign(pieces.size(), 0.0f);
    for (const Piece& piece : pieces) model.fades.push_back(piece.isFading ? 1 : 0);
    if (sights.lists.empty()) return;
    const Gathered gathered = gather(hits_, field_, sights.lists);
    for (size_t f = 0; f < pieces.size(); ++f) {
        const size_t place = model.placeOf(f);
        for (const ClippedPatch& patch : pieces[f].candidate.patches)
            model.shown[place] += patch.area * patch.radiance;
        model.shown[place] /= pieces[f].candidate.area;
        model.coloured[f] = colouredShare(pieces[f].candidate);
        const size_t begin = sights.first[f];
        const size_t end = sights.first[f + 1];
        if (begin == end) continue;
        model.area[f] = pieces[f].candidate.area;
        model.direct[place] = sights.direct[f];
        const auto per = 1.0f / static_cast<float>(end - begin);
        for (size_t k = begin; k < end; ++k) {
            model.gathered[place] += per * gathered.irradiance[k];
            addMissed(missedOf(hits_, sights.lists[k]), per, model.missed[place]);
        }
    }
}

LitSides LampEvidence::settle(std::span<Piece> lamps, const OutsideLight& outside)
{
    std::vector<glm::vec3> direct(hits_.sideOfList.size(), glm::vec3(0.0f));
    std::vector<uint8_t> shines(field_.shines.size(), 0);
    auto onSides = directOfLists(texels_, scene_, hits_, soughtOf(lamps, 1, kRaysToSettle));
    for (size_t f = 0; f < lamps.size(); ++f) {
        lamps[f].onSides = std::move(onSides[f]);
        addDirect(lamps[f].onSides, lamps[f].radiance, direct);
        for (const ClippedPatch& patch : lamps[f].candidate.patches)
            if (patch.surfel != Surfels::kNone) shines[patch.surfel] = 1;
    }
    LitSides sides = lightSides(texels_, hits_, radiance_, std::move(direct), shines, outside);
    field_ = sides.field;
    field_.outside = {}; // fitted apart
    return sides;
}

} // namespace relamp
