#include "solve/white_scale.h"

#include "albedo/divide.shared.h"
#include "base/radiometry.shared.h"
#include "shading/tempering.h"

#include <vector>

#include <fmt/format.h>
#include <glm/exponential.hpp>

namespace relamp
{

namespace
{

constexpr float kMuch = 3.0f; // times: the paint of a room's usual surface is that far from white

} // namespace

void scaleToWhite(std::span<const glm::vec3> irradiance, FoundRoom& room)
{
    const std::vector<uint32_t>& white = room.found.white;
    if (white.empty()) return;
    std::vector<glm::vec3> light;
    light.reserve(white.size());
    for (const uint32_t s : white) light.push_back(irradiance[s]);
    light = tempered(room.tempering, std::move(light));
    glm::vec3 log(0.0f);
    for (size_t i = 0; i < white.size(); ++i) {
        const glm::vec3 paper = kPi * room.radiance.plain[white[i]] / kWhitestPaper;
        log += glm::log(glm::max(paper, glm::vec3(kFaintest))) -
               glm::log(glm::max(light[i], glm::vec3(kFaintest)));
    }
    room.tempering.scale = glm::exp(log / static_cast<float>(white.size()));
    const float brighter = 1.0f / luminance(room.tempering.scale);
    if (brighter > kMuch || brighter < 1.0f / kMuch)
        room.warnings.push_back(fmt::format(
            "albedo where something was called white came to {:.2g}, and all of the room was made "
            "{:.2g} times as bright: is it white?",
            kWhitestPaper / brighter, brighter));
}

} // namespace relamp
