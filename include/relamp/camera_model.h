#pragma once

#include "relamp/api.h"
#include "relamp/response.h"

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How much brighter a texture shows some places of a scan than others, for the camera's exposure
/// and white balance drifted: logarithms on a lattice in space, trilinear between its knots and
/// constant beyond (docs/method/camera.md).
struct RELAMP_API Gain
{
    glm::vec3 origin{0.0f};     // world, m: of the first knot
    float spacing = 1.0f;       // m, > 0
    std::array<int, 3> count{}; // of knots along x, y, z; 0: the gain is 1 everywhere
    std::vector<glm::vec3> log; // of red, green and blue; x fastest, then y, then z

    bool operator==(const Gain&) const = default;

    [[nodiscard]] bool isOne() const { return log.empty(); }
    [[nodiscard]] glm::vec3 at(glm::vec3 position) const; // > 0
    [[nodiscard]] float stops() const; // of luminance, from the darkest knot to the brightest
};

/// Local tone mapping: brightness over half a metre was raised to a power, and detail kept as it
/// was.
struct LocalTone
{
    float exponent = 1.0f; // of brightness, > 0; less flattens, 1: there was none
    Gain gain;             // what that came to

    bool operator==(const LocalTone&) const = default;
};

/// What a camera made of the light of a scan: texture = response of (local tone of (gain *
/// radiance)).
struct RELAMP_API CameraModel
{
    Response response;
    LocalTone tone;
    std::vector<Gain> gains; // one a room, over its places; empty: 1 everywhere
    float drifted = 0.0f;    // how likely exposure did, 0..1; else gains are what no lamp explains

    bool operator==(const CameraModel&) const = default;
    [[nodiscard]] bool isNeutral() const
    {
        return response.isStraight() && tone.gain.isOne() && gains.empty();
    }
    [[nodiscard]] bool hasDrifted() const { return drifted > 0.5f; }
    [[nodiscard]] float stops() const; // of the gain that has most
};

} // namespace relamp
