#pragma once

#include "relamp/scan.h"

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// The surfaces of a scan as a page loads them, and what room.js says of them.
///
/// Each mesh has its vertices, 12 bytes each: x, y, z in 16 bits of its box, the normal
/// (web_direction.h), u, v in 16 bits of their own box; and its triangles; both as meshoptimizer
/// encodes them.
struct WebGeometry
{
    std::vector<uint8_t> bytes;
    nlohmann::ordered_json meshes;
};

WebGeometry webGeometry(const Scan& scan);

} // namespace relamp
