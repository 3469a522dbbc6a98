#include "scan/linearization.h"

#include "scan/gain.h"

#include <algorithm>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace relamp
{

namespace
{

/// Of each room: the mean place of its surfaces, for some surfels of every room lie astray.
std::vector<glm::vec3> middlesOf(const Surfels& surfels, std::span<const uint8_t> roomOfSurfel)
{
    const size_t rooms = 1u + *std::max_element(roomOfSurfel.begin(), roomOfSurfel.end());
    std::vector<glm::dvec3> sum(rooms, glm::dvec3(0.0));
    std::vector<double> area(rooms, 0.0);
    for (size_t s = 0; s < surfels.count(); ++s) {
        const auto own = static_cast<double>(surfels.area[s]);
        sum[roomOfSurfel[s]] += own * glm::dvec3(surfels.position[s]);
        area[roomOfSurfel[s]] += own;
    }
    std::vector<glm::vec3> middles;
    for (size_t room = 0; room < rooms; ++room)
        middles.emplace_back(sum[room] / std::max(area[room], 1e-30));
    return middles;
}

/// By places and not by number: another run may count rooms of one size the other way round.
std::vector<size_t> gainsOfRooms(std::span<const Gain> gains, std::span<const glm::vec3> middles)
{
    std::vector<size_t> ofRooms;
    for (const glm::vec3 middle : middles) {
        const auto distance = [&](const Gain& gain) {
            const glm::vec3 steps(gain.count[0] - 1, gain.count[1] - 1, gain.count[2] - 1);
            return glm::distance(middle, gain.origin + 0.5f * gain.spacing * steps);
        };
        const auto nearest =
            std::min_element(gains.begin(), gains.end(), [&](const Gain& a, const Gain& b) {
                return distance(a) < distance(b);
            });
        ofRooms.push_back(static_cast<size_t>(nearest - gains.begin()));
    }
    return ofRooms;
}

} // namespace

Linearization linearizationOf(const CameraModel& camera, const Surfels& surfels,
                              std::span<const uint8_t> roomOfSurfel)
{
    Linearization linearization{.response = camera.response};
    if (camera.gains.empty() && camera.tone.gain.isOne()) return linearization;
    const bool isHouse = camera.gains.size() > 1 && !roomOfSurfel.empty();
    std::vector<size_t> ofRooms;
    if (isHouse) ofRooms = gainsOfRooms(camera.gains, middlesOf(surfels, roomOfSurfel));
    const auto gainAt = [&](size_t s) {
        if (camera.gains.empty()) return glm::vec3(0.0f);
        const size_t gain = isHouse ? ofRooms[roomOfSurfel[s]] : 0;
        return logAt(camera.gains[gain], surfels.position[s]);
    };
    linearization.perGain.reserve(surfels.count());
    for (size_t s = 0; s < surfels.count(); ++s)
        linearization.perGain.push_back(
            glm::exp(-logAt(camera.tone.gain, surfels.position[s]) - gainAt(s)));
    return linearization;
}

} // namespace relamp
