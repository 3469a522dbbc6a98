#pragma once

#include "relamp/lights.h"
#include "relamp/scan.h"

#include <cstdint>
#include <string>
#include <vector>

namespace relamp
{

/// A picture file as it goes into a GLB.
struct EncodedImage
{
    std::vector<uint8_t> bytes; // empty: none
    std::string mimeType;
};

/// What takes the place of a page's baked-in light.
struct RelitPage
{
    EncodedImage albedo;             // of a textured page
    EncodedImage emission;           // of a textured page; empty where nothing shines
    std::vector<float> vertexAlbedo; // of a page of vertices: linear RGB a vertex
};

/// Key of asset.extras under which a GLB says what relamp made of it: `"textures"`, which are
/// `"albedo"` or `"light"`; of the former, how the scan was read and the room's lights.json.
inline constexpr const char* kSignature = "relamp";

/// The scan as a GLB that can be relit: as it came, but with albedo for base colour, emissive
/// textures for what shines, lit materials, and the points and the sun of `lights` as
/// KHR_lights_punctual.
///
/// `pages` belong to scan.pages; the result is the file's bytes. Scans of other formats than glTF
/// get a plain node a mesh. Throws Error(unsupported) beyond the 4 GiB of a GLB.
std::string writeGlb(const Scan& scan, const std::vector<RelitPage>& pages, const Lights& lights);

/// The scan as a GLB that shows its textures as they are, whatever the light: as it came, but with
/// `pages` for base colour and unlit materials (KHR_materials_unlit).
std::string writeUnlitGlb(const Scan& scan, const std::vector<RelitPage>& pages);

} // namespace relamp
