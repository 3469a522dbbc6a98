#pragma once

#include "relamp/relight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// A lattice of places in the air of a room, at which a page takes the light of what stands there;
/// and what room.js says of it.
///
/// Little-endian, x fastest, for each place: the clusters of WebTransport that its rays meet, 16
/// bits each, in the directions of webDirectionOfRay()
/// (air_probes.h). Then for each light, in the order of the
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

} // namespace relamp
