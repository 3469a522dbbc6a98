#pragma once

#include "output/web_harmonics.h"
#include "relamp/relight.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Places in the air of a room at which the light of all directions is asked for again and again.
class AirProbes
{
public:
    /// Casts their rays. `relighter` must outlive this.
    AirProbes(const Relighter& relighter, std::vector<glm::vec3> places);
    ~AirProbes();
    AirProbes(const AirProbes&) = delete;
    AirProbes& operator=(const AirProbes&) = delete;

    /// At each place under the light that was set with Solver::gather, as fine as a surfel.
    [[nodiscard]] std::vector<WebHarmonics> light() const;
    /// Of each place: lies in the open, and not in furniture or behind a wall.
    [[nodiscard]] const std::vector<uint8_t>& isOpen() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Direction `i` of `count` that are spread evenly all around: a spiral by the golden angle.
glm::vec3 webDirectionOfRay(size_t i, size_t count);

} // namespace relamp
