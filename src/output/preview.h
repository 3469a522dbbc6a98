#pragma once

#include "image/write_image.h"
#include "relamp/camera.h"
#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/scan.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// The layers that a preview shows of one page, small: linear half RGB as scanned, of its albedo,
/// of its shading. What is looked up together lies together.
struct PreviewPage
{
    static constexpr size_t kSamples = 9; // of a pixel

    Size size;
    int shrink = 1; // pages' pixels a pixel here, along each side
    std::vector<uint16_t> samples;
};

/// Shrinks a page's layers to what a picture needs, of `pages` that show the scan together.
PreviewPage previewOf(const Page& page, const PageLayers& layers, size_t pages);

struct PreviewPicture
{
    static constexpr int kRowHeight = 400; // pixels, of what one camera shows

    Size size;
    std::vector<uint8_t> rgb; // sRGB
};

/// The room from every camera: a row each, as scanned, its albedo, its shading. The shading is
/// scaled so that its 95th percentile is white where it is brighter than that.
PreviewPicture renderPreview(const Texels& texels, const RayScene& scene,
                             const std::vector<PreviewPage>& pages,
                             const std::vector<Camera>& cameras, const Progress& progress);

} // namespace relamp
