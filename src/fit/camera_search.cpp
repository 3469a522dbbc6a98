#include "fit/camera_search.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/white_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace relamp
{
namespace
{

// Log odds of a camera with a contrast curve: three in four. One that makes contrast less, as fused
// brackets, is one in four.
constexpr double kCurvedNats = 1.1;
constexpr double kTonedNats = -2.2; // likewise of local tone mapping: one in ten

// Numerics.
constexpr int kCameraRounds = 2;  // of what is gathered and what the camera made of it
constexpr double kLeftOpen = 0.4; // from even odds: beyond, a drift does not turn them

/// What a drift of exposure may have done beside a contrast.
CameraColumns coarseDriftOf(const RoomLight& room)
{
    CameraColumns drift = columnsOf(coarseGainOver(room.position), room.texturePlaces());
    drift.worth = 1.0; // as for lamps
    return drift;
}

/// All of it, by pairs that are worth so many times N; nothing in a room too small for a drift.
CameraColumns fineDriftOf(const RoomLight& room, double worth)
{
    const Gain gain = evenGainOver(room.position);
    if (gain.isOne()) return {};
    CameraColumns drift = columnsOf(gain, room.texturePlaces());
    drift.worth = worth;
    return drift;
}

/// With the first coefficients of its camera alone.
LightEstimate ofFirst(size_t count, LightEstimate light)
{
    const size_t all = light.camera.size();
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < count; ++k)
            light.cameraCovariance[i * count + k] = light.cameraCovariance[i * all + k];
    light.camera.resize(count);
    light.cameraCovariance.resize(count * count);
    return light;
}

} // namespace

/// Those of what a camera may have done to contrast, near what is known of it.
CameraColumns CameraSearch::contrastColumns(const TexturePlaces& places, bool isCurved,
                                            const std::optional<Gain>& around) const
{
    CameraColumns columns = columnsOf(light_.camera.response, places);
    if (!isCurved) columns = evenSlope(columns);
    return around ? together(columns, columnsOf(light_.camera.tone, *around, places)) : columns;
}

/// Of one room by a camera that did this, and what is `beside` it, with the leaks that are
/// likeliest then.
LightEstimate CameraSearch::contrastOf(const RoomLight& room, bool isCurved,
                                       const std::optional<Gain>& around,
                                       const CameraColumns& beside, int rounds) const
{
    const CameraColumns own = contrastColumns(room.texturePlaces(), isCurved, around);
    CameraColumns columns = together(own, beside);
    LightEstimate light{.log = room.log, .camera = columns.known};
    LightFit fit = room.fit();
    for (int round = 0; round < rounds; ++round) {
        const double open = fit.expectLeaks(light, columns);
        if (!isCurved) columns.expected.front() = flattenedBy(open);
        light = fit.solve(room.emits, light.log, columns);
    }
    return ofFirst(own.count(), std::move(light));
}

/// Of all rooms, by one camera. What errs alike in them is no better known for their number, so
/// what they tell of it is the mean, by places.
LightEstimate CameraSearch::byOneCamera(const HouseLight& light,
                                        std::span<const LightEstimate> fits) const
{
    LightEstimate house = light.joined(fits);
    house.nats = 0.0;
    house.camera.assign(fits.front().camera.size(), 0.0);
    house.cameraCovariance.assign(fits.front().cameraCovariance.size(), 0.0);
    for (size_t r = 0; r < fits.size(); ++r) {
        const double share = light_.shareOf(light.rooms()[r]);
        house.nats += share * fits[r].nats;
        house.occam += share * fits[r].occam;
        for (size_t k = 0; k < house.camera.size(); ++k)
            house.camera[k] += share * fits[r].camera[k];
        for (size_t k = 0; k < house.cameraCovariance.size(); ++k)
            house.cameraCovariance[k] += share * fits[r].cameraCovariance[k];
    }
    return house;
}

/// The same for evidence: `nats` are those against such a camera.
LightEstimate CameraSearch::fitOfContrast(const HouseLight& light,
                                          std::span<const LightEstimate> fits, bool isToned) const
{
    LightEstimate house = byOneCamera(light, fits);
    house.nats += house.occam - (isToned ? kTonedNats : 0.0);
    if (isToned && house.camera.back() <= 0.0) house.nats = INFINITY; // no camera deepens it
    return house;
}

/// What the camera of a house did to contrast, beside what else it may have done in a room.
CameraSearch::Contrast
CameraSearch::contrastOf(const HouseLight& house,
                         const std::function<CameraColumns(const RoomLight&)>& besideOf,
                         double curvedNats) const
{
    const auto isCurved = [](size_t kind) { return (kind & 1u) != 0; };
    const auto isToned = [](size_t kind) { return (kind & 2u) != 0; };
    const auto isSought = [&](size_t kind) {
        return (isResponseSought_ || !isCurved(kind)) && (isGainSought_ || !isToned(kind));
    };
    const std::optional<Gain> none;
    std::optional<Gain> around;
    if (isGainSought_) around = light_.evidence.brightnessAround(light_.camera.response);
    std::array<std::vector<LightEstimate>, 4> ofRooms; // of kinds of cameras
    for (auto& ofKind : ofRooms) ofKind.resize(house.rooms().size());
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        const CameraColumns beside = besideOf(room);
        forEach(ofRooms.size(), [&](size_t k) {
            if (isSought(k))
                ofRooms[k][r] = contrastOf(room, isCurved(k), isToned(k) ? around : none, beside,
                                           kCameraRounds);
        });
    });
    std::array<LightEstimate, 4> fits;
    std::array<double, 4> nats{};
    for (size_t k = 0; k < fits.size(); ++k) {
        fits[k].nats = INFINITY;
        if (isSought(k)) fits[k] = fitOfContrast(house, ofRooms[k], isToned(k));
        nats[k] = fits[k].nats - (isCurved(k) ? curvedNats : 0.0);
    }
    const double least = *std::min_element(nats.begin(), nats.end());
    double sum = 0.0;
    for (double& n : nats) {
        n = std::exp(least - n);
        sum += n;
    }
    return {.curved = (nats[1] + nats[3]) / sum,
            .toned = (nats[2] + nats[3]) / sum,
            .curve = std::move(fits[nats[1] > nats[3] ? 1 : 3])};
}

void CameraSearch::findContrast()
{
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    Contrast found = contrastOf(
        house, [](const RoomLight&) { return CameraColumns{}; }, kCurvedNats);
    if (isGainSought_ && std::abs(found.curved - 0.5) < kLeftOpen)
        found = contrastOf(house, coarseDriftOf, kCurvedNats);
    undo(found);
}

void CameraSearch::undo(const Contrast& found)
{
    const auto sought = [](double belief) { return belief > 0.5 ? belief : 0.0; };
    curved_ = sought(found.curved);
    toned_ = sought(found.toned);
    if (found.curved > 0.0) doubtOfResponse_ = doubtOfResponse(found.curve, found.curved, curved_);
    bend(LampEvidence::kPairsFirst);
}

/// The light that is gathered changes with the contrast, and with it the contrast. What is only
/// likely is undone by as much: the mean over the cameras that it may have been.
void CameraSearch::bend(size_t pairs)
{
    for (int round = 0; round < kCameraRounds && isBent(); ++round) {
        std::optional<Gain> around;
        if (toned_ > 0.0) around = light_.evidence.brightnessAround(light_.camera.response);
        const HouseLight house = light_.house(pairs);
        LightEstimate light = byOneCamera(house, house.estimatesOf([&](const RoomLight& room) {
            const CameraColumns beside =
                isBesideDrift_ ? fineDriftOf(room, worthOfGain(1.0)) : CameraColumns{};
            return contrastOf(room, curved_ > 0.0, around, beside, 1);
        }));
        if (curved_ > 0.0) {
            light_.camera.response = responseOf(light.camera, curved_);
            doubtOfResponse_ = doubtOfResponse(light, curved_, curved_);
        }
        if (toned_ > 0.0)
            light_.camera.tone =
                localToneOf(light_.evidence.brightnessAround(light_.camera.response),
                            toned_ * light.camera.back());
        light_.undoCamera(std::move(light.log));
    }
}

/// Of places, by what they show and the colours of lamps so far.
std::vector<glm::vec3> CameraSearch::albedo() const
{
    std::vector<glm::vec3> albedo(light_.model.places());
    const PackedLight packed(light_.model);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> radiance;
        for (const Piece& piece : light_.pieces)
            radiance.push_back(static_cast<double>(piece.radiance[c]));
        for (size_t o = 0; o < light_.model.outsides; ++o)
            radiance.push_back(static_cast<double>(light_.outside[o][c]));
        std::vector<double> light;
        for (size_t i = 0; i < albedo.size(); ++i)
            light.push_back(static_cast<double>(light_.model.gathered[i][c]));
        packed.add(radiance, 0, light);
        for (size_t i = 0; i < albedo.size(); ++i)
            albedo[i][c] =
                kPi * light_.model.shown[i][c] / std::max(static_cast<float>(light[i]), kFaintest);
    }
    return albedo;
}

/// The light of a room with each of these for its gain, among lamps that are known.
std::vector<LightEstimate> CameraSearch::gainFits(const RoomLight& room,
                                                  std::span<const CameraColumns> columns) const
{
    std::vector<LightEstimate> fits(columns.size());
    LightFit fit = room.fit();
    fit.expectLeaks(room.log);
    forEach(fits.size(),
            [&](size_t k) { fits[k] = fit.solve(room.emits, room.log, columns[k], kFirstWidth); });
    return fits;
}

/// The evidence for a drift, in the mean of all rooms: by an even gain over each of these beside
/// the lamps.
CameraSearch::Drift CameraSearch::driftBy(const HouseLight& house,
                                          std::span<const Gain> lattices) const
{
    const std::span<const RoomParts> rooms = house.rooms();
    std::vector<double> evidence(rooms.size());
    Drift drift{.fits = std::vector<LightEstimate>(rooms.size())};
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        std::array<CameraColumns, 2> columns; // of no drift, and of one
        columns[1] = columnsOf(lattices[r], room.texturePlaces());
        columns[0].worth = columns[1].worth;
        std::vector<LightEstimate> fits = gainFits(room, columns);
        evidence[r] = fits[0].nats + fits[0].occam - fits[1].nats - fits[1].occam;
        drift.fits[r] = std::move(fits[1]);
    });
    for (size_t r = 0; r < rooms.size(); ++r)
        drift.evidence += light_.shareOf(rooms[r]) * evidence[r];
    return drift;
}

void CameraSearch::expectDrift()
{
    if (!isGainSought_) return;
    const std::vector<std::vector<glm::vec3>> positions = positionsByRoom();
    if (evenGainsOver(positions).empty()) return;
    std::vector<Gain> coarse;
    for (const auto& ofRoom : positions) coarse.push_back(coarseGainOver(ofRoom));
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    const Drift drift = driftBy(house, coarse);
    isDriftExpected_ = likelihoodByEvidence(drift.evidence) > 0.5;
    if (!isDriftExpected_) return;
    light_.estimate = house.joined(drift.fits);
    if (isResponseSought_ && curved_ < 0.5 + kLeftOpen) findContrastBesideDrift();
}

/// A drift that is left in the texture hides a contrast, and makes its slopes too low. It is asked
/// for from the start, in the texture as it is.
void CameraSearch::findContrastBesideDrift()
{
    const bool wasBent = isBent();
    const CameraModel camera = light_.camera;
    const LightEstimate estimate = light_.estimate;
    const std::vector<double> noise = light_.noise;
    if (wasBent) {
        light_.camera.response = {};
        light_.camera.tone = {};
        light_.undoCamera(light_.estimate.log);
    }
    const Contrast found = contrastOf(
        light_.house(LampEvidence::kPairsFirst),
        [](const RoomLight& room) { return fineDriftOf(room, kGainWorth); }, -kCurvedNats);
    if (found.curved > 0.5 && isFlattening(found.curve.camera)) {
        isBesideDrift_ = true;
        undo(found);
    } else if (wasBent) {
        light_.camera = camera;
        light_.linearize();
        light_.estimate = estimate;
        light_.noise = noise;
    }
}

CameraColumns CameraSearch::driftOf(const RoomLight& room) const
{
    return isDriftExpected_ ? coarseDriftOf(room) : CameraColumns{};
}

/// Undoes a drift of exposure that is likelier than not, and returns how likely it is.
double CameraSearch::findDrift()
{
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    const Drift drift = driftBy(house, light_.camera.gains);
    const double drifted = likelihoodByEvidence(drift.evidence);
    light_.camera.drifted = static_cast<float>(drifted);
    if (light_.camera.hasDrifted()) undoDrift(house.rooms(), drift.fits);
    return drifted;
}

void CameraSearch::undoDrift(std::span<const RoomParts> rooms, std::span<const LightEstimate> found)
{
    std::vector<double> log = light_.estimate.log;
    for (size_t r = 0; r < rooms.size(); ++r) {
        rooms[r].put(found[r].log, log);
        light_.camera.gains[r] = gainOf(std::move(light_.camera.gains[r]), found[r].camera);
    }
    light_.undoCamera(std::move(log));
}

/// Of the places of each room.
std::vector<std::vector<glm::vec3>> CameraSearch::positionsByRoom() const
{
    const std::span<const glm::vec3> all = light_.evidence.texturePlaces().position;
    const std::span<const uint8_t> room = light_.evidence.roomOfPlace();
    std::vector<std::vector<glm::vec3>> positions(light_.noise.size());
    for (size_t i = 0; i < all.size(); ++i) positions[room.empty() ? 0 : room[i]].push_back(all[i]);
    return positions;
}

/// A drift between walls looks like paint, so that pairs across them are drawn once most of it is
/// undone. One round is enough where none is likely: what is gathered hardly changes then.
void CameraSearch::findGain()
{
    if (!isGainSought_) return;
    light_.camera.gains = evenGainsOver(positionsByRoom());
    if (light_.camera.gains.empty()) return;
    const double drifted = findDrift();
    if (light_.camera.hasDrifted()) {
        findWhiteBalance(drifted);
        light_.evidence.pairWalls(albedo());
    }
    for (int round = 0; round < (light_.camera.hasDrifted() ? kCameraRounds : 1); ++round) {
        const HouseLight house = light_.house(LampEvidence::kPairsFirst);
        std::vector<LightEstimate> fits(house.rooms().size());
        house.forEachRoom([&](size_t r, const RoomLight& room) {
            CameraColumns columns = columnsOf(light_.camera.gains[r], room.texturePlaces());
            columns.worth = worthOfGain(drifted);
            fits[r] = std::move(gainFits(room, {&columns, 1}).front());
        });
        undoDrift(house.rooms(), fits);
    }
    findWhiteBalance(drifted);
}

void CameraSearch::findWhiteBalance(double drifted)
{
    const std::vector<glm::vec3> albedo = this->albedo();
    const HouseLight house = light_.house(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        std::vector<glm::vec3> ofRoom;
        for (const uint32_t place : room.of.places) ofRoom.push_back(albedo[place]);
        light_.camera.gains[r] =
            withWhiteBalance(std::move(light_.camera.gains[r]), room.position, ofRoom, room.pairs,
                             room.told, {drifted, LightFit::effectivePairs(room.model)});
    });
    light_.undoCamera(light_.estimate.log);
}

} // namespace relamp
