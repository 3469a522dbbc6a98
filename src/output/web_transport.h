#pragma once

#include "relamp/relight.h"

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// How light bounces in a room, coarse enough for a browser to follow it between two pictures: the
/// relighter's transport between clusters of its sides, and what room.js says of it.
///
/// Little-endian, for each cluster, those of fronts first: its place, x, y, z in 16 bits of the
/// box; its normal (web_direction.h); its albedo, RGB, 8 bits of the square root. Then for each
/// cluster `points` places on it at which light is looked for, each as likely: place and normal.
/// Then for each cluster the clusters that its rays met, `rays` of them, ascending, each as the
/// difference to the one before: bytes, of which 255 means that and the next; what is beyond the
/// last cluster is nothing.
struct WebTransport
{
    std::vector<uint8_t> bytes;
    nlohmann::ordered_json json;
};

WebTransport webTransport(const Relighter& relighter);

} // namespace relamp
