#pragma once

#include "relamp/image.h"
#include "relamp/lights.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// A FixtureMap as 8-bit RGB, 3 bytes a pixel: R + 256 G + 65536 B is the number of the fixture and
/// one more; black is no burnt-out texel, white one that is no fixture's.
std::vector<uint8_t> rgbOf(const FixtureMap& map);

/// The same back. Throws Error(malformed) where the picture is none of 8 bits; `name` is what to
/// call it.
FixtureMap fixtureMapFrom(const Image& picture, const std::string& name);

/// What a result's folder says, one map a page of its scan. Throws Error(cannotRead | malformed).
std::vector<FixtureMap> readFixtureMaps(const std::filesystem::path& folder, size_t pages);

} // namespace relamp
