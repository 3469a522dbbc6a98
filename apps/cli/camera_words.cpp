#include "camera_words.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace
{

/// Whether two decimals show a difference.
bool differs(double value, double neutral)
{
    return std::abs(value - neutral) >= 0.005;
}

} // namespace

std::string deedsOf(const relamp::CameraModel& camera)
{
    std::vector<std::string> deeds;
    if (!camera.response.isStraight())
        deeds.push_back(fmt::format("contrast {:.2f}", camera.response.contrast()));
    if (!camera.tone.gain.isOne())
        deeds.push_back(
            fmt::format("local tone mapping to the power {:.2f}", camera.tone.exponent));
    if (camera.hasDrifted() && differs(camera.stops(), 0.0))
        deeds.push_back(fmt::format("exposure drifts over {:.2f} stops", camera.stops()));
    return fmt::format("{}", fmt::join(deeds, ", "));
}

std::string unexplainedBy(const relamp::CameraModel& camera)
{
    if (camera.hasDrifted() || !differs(camera.stops(), 0.0)) return {};
    return fmt::format("smooth over the room, over {:.2f} stops", camera.stops());
}
