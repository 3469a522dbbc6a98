#pragma once

#include "relamp/api.h"
#include "relamp/relight.h"

#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A place on the surface of a room.
struct SurfacePlace
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec3 normal{0.0f};   // unit, away from the lit side
};

struct LightAtPlace
{
    glm::vec3 shading{0.0f};  // irradiance / pi: the radiance of a white surface
    glm::vec3 emission{0.0f}; // radiance of what is burnt out in the texture there, if it is a lamp
                              // that is on; else 0
};

/// Places at which the light is asked for again and again, as a picture that is drawn at once needs
/// it: each knows its surfels, and an answer is a sum over them.
class RELAMP_API LightProbes
{
public:
    /// What is further than 12 cm from any surface of the room sees no light.
    LightProbes(const Relighter& relighter, std::span<const SurfacePlace> places);
    ~LightProbes();
    LightProbes(LightProbes&&) noexcept;
    LightProbes& operator=(LightProbes&&) noexcept;

    /// The light at every place, in their order, as the relighter's last `glance` or `light` with
    /// Solver::gather found it; as fine as a surfel. `relighter` is that of the constructor.
    [[nodiscard]] std::vector<LightAtPlace> light(const Relighter& relighter) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace relamp
