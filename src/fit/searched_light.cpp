#include "fit/searched_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr double kNoiseOfPairs = 0.7; // of the median difference of pairs: half are of two paints
constexpr double kLeastNoise = 0.02;  // log; what a byte and a few rays tell

} // namespace

void SearchedLight::add(Piece piece)
{
    pieces.push_back(std::move(piece));
    for (auto* kinsOf : {&kin.model, &kin.leansOn}) kinsOf->emplace_back();
}

void SearchedLight::relate(const RayScene& scene)
{
    sights = evidence.sightsOf(pieces);
    kin = kinshipOf(pieces, scene);
}

void SearchedLight::begin()
{
    const std::span<const uint8_t> rooms = evidence.roomOfPlace();
    const auto last = std::max_element(rooms.begin(), rooms.end());
    noise.assign(last == rooms.end() ? 1 : size_t{1} + *last, kFirstNoise);
    observe();
    estimate.log.assign(model.pieces + model.outsides, 0.0); // of other rooms, to begin with
    solve([](const RoomLight& room) {
        const LightFit fit = room.fit();
        return fit.solve(room.emits, fit.beginning(), kFirstWidth);
    });
}

HouseLight SearchedLight::house(size_t pairs, const LightModel& of) const
{
    return {{of, evidence.pairs(pairs), kin.alike, noiseOfAll(), emits, estimate.log, camera,
             evidence.texturePlaces(), evidence.told(), isResponseKnown},
            evidence.roomOfPlace(),
            noise};
}

double SearchedLight::shareOf(const RoomParts& room) const
{
    return static_cast<double>(room.places.size()) / static_cast<double>(model.places());
}

double SearchedLight::noiseOfAll() const
{
    return std::accumulate(noise.begin(), noise.end(), 0.0) / static_cast<double>(noise.size());
}

void SearchedLight::solve(const std::function<LightEstimate(const RoomLight&)>& estimateOf)
{
    const HouseLight house = this->house(LampEvidence::kPairsFirst);
    const std::vector<LightEstimate> estimates = house.estimatesOf(estimateOf);
    estimate = house.joined(estimates);
    for (size_t r = 0; r < estimates.size(); ++r)
        noise[r] = std::max(kNoiseOfPairs * estimates[r].residual, kLeastNoise);
}

double SearchedLight::linearize()
{
    const double brighter = evidence.linearize(camera);
    gatherAnew();
    return brighter;
}

void SearchedLight::undoCamera(std::vector<double> log)
{
    const double brighter = linearize();
    for (double& l : log) l += brighter;
    estimate.log = std::move(log);
    solve([](const RoomLight& room) { return room.fit().solve(room.emits, room.log, 1.0); });
}

} // namespace relamp
