#include "camera_words.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

std::string deedsOf(const relamp::CameraModel& camera)
{
    std::vector<std::string> deeds;
    if (!camera.response.isStraight())
        deeds.push_back(fmt::format("contrast {:.2f}", camera.response.contrast()));
    if (!camera.tone.gain.isOne())
        deeds.push_back(
            fmt::format("local tone mapping to the power {:.2f}", camera.tone.exponent));
    if (!camera.gain.isOne())
        deeds.push_back(fmt::format("exposure drifts over {:.2f} stops", camera.gain.stops()));
    return fmt::format("{}", fmt::join(deeds, ", "));
}
