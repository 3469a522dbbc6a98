#pragma once

#include "output/web_harmonics.h"
#include "relamp/relight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

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

/// A lattice of places in the air of a room, at which a page takes the light of what stands there;
/// and what room.js says of it.
///
/// Little-endian, x fastest, for each place: the clusters of WebTransport that its rays meet, 16
/// bits each, in the directions of webDirectionOfRay(). Then for each light, in the order of the
/// page's, for each place: nine RGB of WebHarmonics, a byte each: the first is 255 (value /
/// scale)^(1/4), the others shares of it, 127.5 (1 + share / sqrt(2 l + 1)).
class WebProbes
{
public:
    explicit WebProbes(const Relighter& relighter);
    ~WebProbes();
    WebProbes(const WebProbes&) = delete;
    WebProbes& operator=(const WebProbes&) = delete;

    /// Takes in the light that was set.
    void add();

    [[nodiscard]] std::span<const uint8_t> bytes() const;
    [[nodiscard]] nlohmann::ordered_json json() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Direction `i` of `count` that are spread evenly all around: a spiral by the golden angle.
glm::vec3 webDirectionOfRay(size_t i, size_t count);

} // namespace relamp
