#pragma once

#include "output/web_direction.h"
#include "relamp/scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// Two bytes, the lower one first.
inline void addWord(std::vector<uint8_t>& bytes, uint16_t word)
{
    bytes.push_back(static_cast<uint8_t>(word & 255));
    bytes.push_back(static_cast<uint8_t>(word >> 8));
}

/// A place, 16 bits of the box a coordinate, and a direction.
inline void addSite(std::vector<uint8_t>& bytes, const Bounds& box, glm::vec3 place,
                    glm::vec3 direction)
{
    for (int axis = 0; axis < 3; ++axis) {
        const float share =
            (place[axis] - box.low[axis]) / std::max(box.high[axis] - box.low[axis], 1e-6f);
        addWord(bytes,
                static_cast<uint16_t>(std::lround(65535.0f * std::clamp(share, 0.0f, 1.0f))));
    }
    addWord(bytes, webDirection(direction));
}

inline nlohmann::ordered_json webBox(const Bounds& box)
{
    const glm::vec3 extent = box.extent();
    return {{"low", {box.low.x, box.low.y, box.low.z}}, {"extent", {extent.x, extent.y, extent.z}}};
}

} // namespace relamp
