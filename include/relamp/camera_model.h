#pragma once

#include "relamp/api.h"
#include "relamp/response.h"

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How much brighter a texture shows some places of a scan than others, for the camera's exposure
/// drifted: logarithms on a lattice in space, trilinear between its knots and constant beyond
/// (docs/method/camera.md).
struct RELAMP_API Gain
{
    glm::vec3 origin{0.0f};     // world, m: of the first knot
    float spacing = 1.0f;       // m, > 0
    std::array<int, 3> count{}; // of knots along x, y, z; 0: the gain is 1 everywhere
    std::vector<float> log;     // x fastest, then y, then z; within -5..5

    bool operator==(const Gain&) const = default;

    [[nodiscard]] bool isOne() const { return log.empty(); }
    [[nodiscard]] float at(glm::vec3 position) const; // > 0
    [[nodiscard]] float stops() const;                // from the darkest knot to the brightest
};

/// What a camera made of the light of a scan: texture = response of (gain * radiance).
struct CameraModel
{
    Response response;
    Gain gain;

    bool operator==(const CameraModel&) const = default;
    [[nodiscard]] bool isNeutral() const { return response.isStraight() && gain.isOne(); }
};

} // namespace relamp
