#pragma once

#include "output/usd_lights.h"
#include "relamp/scan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// What a page of the scan shows in a USD scene.
struct UsdPage
{
    std::string albedo;                // file beside the scene, sRGB; of a textured page
    std::string emission;              // file beside it, linear radiance; or none
    bool hasOpacity = false;           // as the albedo's fourth channel
    std::vector<float> vertexAlbedo;   // of a page of vertices: linear RGB a vertex
    std::vector<float> vertexEmission; // likewise radiance; or none
};

/// Writes the scan as a USD scene, as text: meshes in metres, Y up, with UsdPreviewSurface
/// materials, and `lights` by UsdLux, whose intensities are radiance, of the sun irradiance. The
/// variant set "light" of the root has either lamps as lights or, as "emissive", surfaces that
/// shine, so that nothing lights twice. docs/guide/engines.md describes it.
///
/// `pages` belong to scan.pages. Throws Error(cannotWrite).
void writeUsdScene(const std::filesystem::path& file, const Scan& scan,
                   const std::vector<UsdPage>& pages, const UsdLights& lights);

} // namespace relamp
