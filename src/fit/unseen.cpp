#include "fit/unseen.h"

#include "base/parallel.h"
#include "fit/light_fit.h"
#include "scan/held_out.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace relamp
{
namespace
{

CameraColumns columnsSought(const FittedLight& light)
{
    const CameraModel& camera = light.camera;
    if (!camera.gains.empty()) return columnsOf(camera.gains.front(), light.texture);
    if (camera.response.isStraight() || light.isResponseKnown) return {};
    return columnsOf(camera.response, light.texture);
}

/// The same with a sun's rim behind the places, which has no camera of its own.
CameraColumns columnsOf(const FittedLight& light)
{
    CameraColumns columns = columnsSought(light);
    const size_t places = light.model.places();
    const size_t slopes = columns.slopes();
    columns.bend.resize(places * columns.count(), 0.0f);
    if (slopes == 0) return columns;
    columns.slope.resize(places * slopes, 0.0f);
    columns.slopeKnown.resize(places, 1.0f);
    return columns;
}

/// Of all places, as these pairs tell it, and those that a person told of.
std::vector<double> logAlbedoBy(const FittedLight& light, const CameraColumns& camera,
                                std::span<const MaterialPair> pairs,
                                std::span<const MaterialPair> told)
{
    LightFit fit(light.model, pairs, light.alike, light.noise);
    fit.believe(told);
    fit.expectLeaks(light.log);
    return fit.logAlbedo(fit.solve(light.emits, {light.log.begin(), light.log.end()}, camera),
                         camera);
}

} // namespace

std::vector<float> changeUnseen(const FittedLight& light, uint32_t seed)
{
    std::vector<size_t> fold;
    for (const glm::vec3 place : light.texture.position)
        fold.push_back(static_cast<size_t>(foldOf(place, seed)));
    fold.resize(light.model.places(), kFolds); // a sun's rim has further ones, which all fits see
    const CameraColumns camera = columnsOf(light);
    std::array<std::vector<double>, kFolds + 1> logAlbedo;
    forEach(logAlbedo.size(), [&](size_t k) {
        const auto seenOf = [&](std::span<const MaterialPair> pairs) {
            std::vector<MaterialPair> seen;
            std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(seen),
                         [&](MaterialPair pair) {
                             return k == kFolds || (fold[pair.p] != k && fold[pair.q] != k);
                         });
            return seen;
        };
        logAlbedo[k] = logAlbedoBy(light, camera, seenOf(light.pairs), seenOf(light.told));
    });
    std::vector<float> change;
    for (size_t i = 0; i < light.texture.position.size(); ++i)
        change.push_back(static_cast<float>(logAlbedo[fold[i]][i] - logAlbedo[kFolds][i]));
    return change;
}

} // namespace relamp
