#include "fit/lamp_search.h"

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

constexpr double kCurvedNats = 1.1; // log odds of a camera with a contrast curve: three in four
constexpr double kTonedNats = -2.2; // likewise of local tone mapping: one in ten

// Numerics.
constexpr int kCameraRounds = 2;      // of what is gathered and what the camera made of it
constexpr double kLeastBelief = 0.05; // of a camera: to undo less of it changes nothing

} // namespace

/// Those of what a camera may have done to contrast, near what is known of it.
CameraColumns LampSearch::contrastColumns(const TexturePlaces& places, bool isCurved,
                                          const std::optional<Gain>& around) const
{
    CameraColumns columns = columnsOf(camera_.response, places);
    if (!isCurved) columns = evenSlope(columns);
    return around ? together(columns, columnsOf(camera_.tone, *around, places)) : columns;
}

/// Of one room by a camera that did this, with the leaks that are likeliest then.
LightEstimate LampSearch::contrastOf(const RoomLight& room, bool isCurved,
                                     const std::optional<Gain>& around, int rounds) const
{
    CameraColumns columns = contrastColumns(room.texturePlaces(), isCurved, around);
    LightEstimate light{.log = room.log, .camera = columns.known};
    LightFit fit = room.fit();
    for (int round = 0; round < rounds; ++round) {
        const double open = fit.expectLeaks(light, columns);
        if (!isCurved) columns.expected.front() = flattenedBy(open);
        light = fit.solve(room.emits, light.log, columns);
    }
    return light;
}

/// Of the house's places, those that are a room's.
double LampSearch::shareOf(const RoomParts& room) const
{
    return static_cast<double>(room.places.size()) / static_cast<double>(model_.places());
}

/// Of all rooms, by one camera. What errs alike in them is no better known for their number, so
/// what they tell of it is the mean, by places.
LightEstimate LampSearch::byOneCamera(const HouseLight& light,
                                      std::span<const LightEstimate> fits) const
{
    LightEstimate house = light.joined(fits);
    house.nats = 0.0;
    house.camera.assign(fits.front().camera.size(), 0.0);
    house.cameraCovariance.assign(fits.front().cameraCovariance.size(), 0.0);
    for (size_t r = 0; r < fits.size(); ++r) {
        const double share = shareOf(light.rooms()[r]);
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
LightEstimate LampSearch::fitOfContrast(const HouseLight& light,
                                        std::span<const LightEstimate> fits, bool isCurved,
                                        bool isToned) const
{
    LightEstimate house = byOneCamera(light, fits);
    house.nats += house.occam - (isCurved ? kCurvedNats : 0.0) - (isToned ? kTonedNats : 0.0);
    if (isToned && house.camera.back() <= 0.0) house.nats = INFINITY; // no camera deepens it
    return house;
}

/// How likely a response and local tone mapping are beside all pieces that may emit.
void LampSearch::findContrast()
{
    const auto isCurved = [](size_t kind) { return (kind & 1u) != 0; };
    const auto isToned = [](size_t kind) { return (kind & 2u) != 0; };
    const auto isSought = [&](size_t kind) {
        return (isResponseSought_ || !isCurved(kind)) && (isGainSought_ || !isToned(kind));
    };
    const std::optional<Gain> none;
    std::optional<Gain> around;
    if (isGainSought_) around = evidence_.brightnessAround(camera_.response);
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    std::array<std::vector<LightEstimate>, 4> ofRooms; // of kinds of cameras
    for (auto& ofKind : ofRooms) ofKind.resize(house.rooms().size());
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        forEach(ofRooms.size(), [&](size_t k) {
            if (isSought(k))
                ofRooms[k][r] =
                    contrastOf(room, isCurved(k), isToned(k) ? around : none, kCameraRounds);
        });
    });
    std::array<LightEstimate, 4> fits;
    std::array<double, 4> nats{};
    for (size_t k = 0; k < fits.size(); ++k) {
        fits[k].nats = INFINITY;
        if (isSought(k)) fits[k] = fitOfContrast(house, ofRooms[k], isCurved(k), isToned(k));
        nats[k] = fits[k].nats;
    }
    const double least = *std::min_element(nats.begin(), nats.end());
    double sum = 0.0;
    for (double& n : nats) {
        n = std::exp(least - n);
        sum += n;
    }
    const auto sought = [](double belief) { return belief > kLeastBelief ? belief : 0.0; };
    const double likely = (nats[1] + nats[3]) / sum;
    curved_ = sought(likely);
    if (likely > 0.0)
        doubtOfResponse_ = doubtOfResponse(fits[nats[1] > nats[3] ? 1 : 3], likely, curved_);
    toned_ = sought((nats[2] + nats[3]) / sum);
    bend(LampEvidence::kPairsFirst);
}

/// The light that is gathered changes with the contrast, and with it the contrast. What is only
/// likely is undone by as much: the mean over the cameras that it may have been.
void LampSearch::bend(size_t pairs)
{
    for (int round = 0; round < kCameraRounds && isBent(); ++round) {
        std::optional<Gain> around;
        if (toned_ > 0.0) around = evidence_.brightnessAround(camera_.response);
        const HouseLight house = houseLight(pairs);
        LightEstimate light = byOneCamera(house, house.estimatesOf([&](const RoomLight& room) {
            return contrastOf(room, curved_ > 0.0, around, 1);
        }));
        if (curved_ > 0.0) {
            camera_.response = responseOf(light.camera, curved_);
            doubtOfResponse_ = doubtOfResponse(light, curved_, curved_);
        }
        if (toned_ > 0.0)
            camera_.tone = localToneOf(evidence_.brightnessAround(camera_.response),
                                       toned_ * light.camera.back());
        seeByCamera(std::move(light.log));
    }
}

/// Of places, by what they show and the colours of lamps so far.
std::vector<glm::vec3> LampSearch::albedo() const
{
    std::vector<glm::vec3> albedo(model_.places());
    const PackedLight packed(model_);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> radiance;
        for (const Piece& piece : pieces_)
            radiance.push_back(static_cast<double>(piece.radiance[c]));
        for (size_t o = 0; o < model_.outsides; ++o)
            radiance.push_back(static_cast<double>(outside_[o][c]));
        std::vector<double> light;
        for (size_t i = 0; i < albedo.size(); ++i)
            light.push_back(static_cast<double>(model_.gathered[i][c]));
        packed.add(radiance, 0, light);
        for (size_t i = 0; i < albedo.size(); ++i)
            albedo[i][c] =
                kPi * model_.shown[i][c] / std::max(static_cast<float>(light[i]), kFaintest);
    }
    return albedo;
}

HouseLight LampSearch::houseLight(size_t pairs) const
{
    return houseLight(pairs, model_);
}

HouseLight LampSearch::houseLight(size_t pairs, const LightModel& model) const
{
    return {{model, evidence_.pairs(pairs), kin_.alike, noiseOfAll(), emits_, estimate_.log,
             camera_, evidence_.texturePlaces(), evidence_.told(), !isResponseSought_},
            evidence_.roomOfPlace(),
            noise_};
}

/// The light of a room with each of these for its gain, among lamps that are known.
std::vector<LightEstimate> LampSearch::gainFits(const RoomLight& room,
                                                std::span<const CameraColumns> columns) const
{
    std::vector<LightEstimate> fits(columns.size());
    LightFit fit = room.fit();
    fit.expectLeaks(room.log);
    forEach(fits.size(),
            [&](size_t k) { fits[k] = fit.solve(room.emits, room.log, columns[k], kFirstWidth); });
    return fits;
}

/// Undoes a drift of exposure that is likelier than not, and returns how likely it is: by an even
/// gain beside the lamps that are known, in the mean of all rooms.
double LampSearch::findDrift()
{
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    const std::span<const RoomParts> rooms = house.rooms();
    std::vector<LightEstimate> drifting(rooms.size());
    std::vector<double> evidence(rooms.size());
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        std::array<CameraColumns, 2> columns; // of no drift, and of one
        columns[1] = columnsOf(camera_.gains[r], room.texturePlaces());
        columns[0].worth = columns[1].worth;
        std::vector<LightEstimate> fits = gainFits(room, columns);
        evidence[r] = fits[0].nats + fits[0].occam - fits[1].nats - fits[1].occam;
        drifting[r] = std::move(fits[1]);
    });
    double mean = 0.0;
    for (size_t r = 0; r < rooms.size(); ++r) mean += shareOf(rooms[r]) * evidence[r];
    const double drifted = likelihoodByEvidence(mean);
    camera_.drifted = static_cast<float>(drifted);
    if (camera_.hasDrifted()) undoDrift(rooms, drifting);
    return drifted;
}

void LampSearch::undoDrift(std::span<const RoomParts> rooms, std::span<const LightEstimate> found)
{
    std::vector<double> log = estimate_.log;
    for (size_t r = 0; r < rooms.size(); ++r) {
        rooms[r].put(found[r].log, log);
        camera_.gains[r] = gainOf(std::move(camera_.gains[r]), found[r].camera);
    }
    seeByCamera(std::move(log));
}

/// Of the places of each room.
std::vector<std::vector<glm::vec3>> LampSearch::positionsByRoom() const
{
    const std::span<const glm::vec3> all = evidence_.texturePlaces().position;
    const std::span<const uint8_t> room = evidence_.roomOfPlace();
    std::vector<std::vector<glm::vec3>> positions(noise_.size());
    for (size_t i = 0; i < all.size(); ++i) positions[room.empty() ? 0 : room[i]].push_back(all[i]);
    return positions;
}

/// The drift of exposure and white balance, among lamps that are known; in every room by itself,
/// for what each shows is hardly lit by the others. One round is enough where none is likely: what
/// is gathered hardly changes then.
void LampSearch::findGain()
{
    camera_.gains = evenGainsOver(positionsByRoom());
    if (camera_.gains.empty()) return;
    const double drifted = findDrift();
    for (int round = 0; round < (camera_.hasDrifted() ? kCameraRounds : 1); ++round) {
        const HouseLight house = houseLight(LampEvidence::kPairsFirst);
        std::vector<LightEstimate> fits(house.rooms().size());
        house.forEachRoom([&](size_t r, const RoomLight& room) {
            CameraColumns columns = columnsOf(camera_.gains[r], room.texturePlaces());
            columns.worth = worthOfGain(drifted);
            fits[r] = std::move(gainFits(room, {&columns, 1}).front());
        });
        undoDrift(house.rooms(), fits);
    }
    findWhiteBalance(drifted);
}

void LampSearch::findWhiteBalance(double drifted)
{
    const std::vector<glm::vec3> albedo = this->albedo();
    const HouseLight house = houseLight(LampEvidence::kPairsFirst);
    house.forEachRoom([&](size_t r, const RoomLight& room) {
        std::vector<glm::vec3> ofRoom;
        for (const uint32_t place : room.of.places) ofRoom.push_back(albedo[place]);
        camera_.gains[r] =
            withWhiteBalance(std::move(camera_.gains[r]), room.position, ofRoom, room.pairs,
                             room.told, {drifted, LightFit::effectivePairs(room.model)});
    });
    seeByCamera(estimate_.log);
}

/// Everything in the radiance that the camera tells, from light that was found with it.
void LampSearch::seeByCamera(std::vector<double> log)
{
    const double brighter = evidence_.linearize(camera_);
    model_ = evidence_.modelOf(pieces_, sights_, std::move(model_.direct));
    for (double& l : log) l += brighter;
    estimate_.log = std::move(log);
    solve([](const RoomLight& room) { return room.fit().solve(room.emits, room.log, 1.0); });
}

} // namespace relamp
