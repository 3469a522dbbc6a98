#pragma once

#include "relamp/api.h"
#include "relamp/relight.h"
#include "relamp/replacing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// One light of a relighting, all others being off.
struct LightPart
{
    std::string name;    // "ceiling lamp 2", "light 1", "sun 1", "sky"; unlike others'
    int fixture = -1;    // its number, where it is a fixture
    Relighting lighting; // this light, and the windows that all of them together have
};

/// The lights of a relighting one by one, those that are dark left out. Light adds up: the radiance
/// of the parts sums to that of the whole, but for the rounding of half floats.
RELAMP_API std::vector<LightPart> partsOf(const Relighting& lighting, const Relighter& relighter);

enum class LightmapFormat {
    exr, // half floats
    png  // 8 bits: the fourth root of the share of a lightmap's brightest value
};

struct LightmapOptions
{
    LightmapFormat format = LightmapFormat::exr;
    int longestSide = 0; // pixels; larger textures are halved until they fit; 0: none is
    Replacing replacing = Replacing::unchanged;
};

/// Throws Error(cannotWrite) where writeLightmaps could not write into `folder`, or would replace
/// what it may not. Worth asking before work that takes long.
RELAMP_API void checkLightmaps(const std::filesystem::path& folder, const LightmapOptions& options);

/// Writes a lightmap of each light, a picture a page, and lightmaps.json, which
/// docs/guide/lightmaps.md describes, into `folder`: whole or not at all. A lightmap holds
/// irradiance / pi with all bounces and shadows; times the albedo it is what that light makes of
/// the room. Pixels that no surface covers continue what lies next to them. Leaves the relighter
/// under the last of the lights. `progress` is told of "lightmap 3 of 7" as a part. Throws
/// Error(cannotWrite | cancelled), the first also where `folder` is the room's own, and
/// Error(unsupported) where no light is on.
RELAMP_API void writeLightmaps(Relighter& relighter, const Relighting& lighting,
                               const std::filesystem::path& folder,
                               const LightmapOptions& options = {},
                               Progress& progress = unwatched());

} // namespace relamp
