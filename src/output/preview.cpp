#include "output/preview.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/transfer.h"
#include "output/camera_rays.h"
#include "scan/surface_point.h"

#include <algorithm>
#include <array>

namespace relamp
{
namespace
{

constexpr int kWidth = 640; // of one picture
constexpr int kHeight = 400;
constexpr int kColumns = 3;
constexpr size_t kRow = size_t{kColumns} * kWidth;
constexpr size_t kShadingColumn = size_t{2} * kWidth; // the last
constexpr int kSamples = 2;                           // of a pixel
constexpr int kLongestSide = 2048;                    // of a page in a preview
constexpr float kNothing = 0.02f;                     // where no surface is seen
constexpr float kBackside = 0.08f;                    // where one is seen from behind

glm::vec3 rgbAt(const std::vector<uint16_t>& layer, size_t pixel)
{
    const uint16_t* rgb = &layer[3 * pixel];
    return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
}

void put(std::vector<uint16_t>& layer, size_t pixel, glm::vec3 rgb)
{
    for (int c = 0; c < 3; ++c) layer[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(rgb[c]);
}

/// Mean of `valueOf(pixel)` over the page's pixels that make up one of the preview's.
template<class ValueOf>
glm::vec3 meanOf(const PageLayers& layers, const PreviewPage& preview, size_t x, size_t y,
                 const ValueOf& valueOf)
{
    const auto step = static_cast<size_t>(preview.shrink);
    const auto width = static_cast<size_t>(layers.width);
    const size_t endX = std::min(width, (x + 1) * step);
    const size_t endY = std::min(static_cast<size_t>(layers.height), (y + 1) * step);
    glm::vec3 sum(0.0f);
    for (size_t py = y * step; py < endY; ++py)
        for (size_t px = x * step; px < endX; ++px) sum += valueOf(py * width + px);
    return sum / static_cast<float>((endX - x * step) * (endY - y * step));
}

/// One pixel of all three pictures.
using Columns = std::array<glm::vec3, kColumns>;

Columns look(const Texels& texels, const std::vector<PreviewPage>& pages, const Hit& hit)
{
    if (hit.missed()) return {glm::vec3(kNothing), glm::vec3(kNothing), glm::vec3(kNothing)};
    if (!hit.front) return {glm::vec3(kBackside), glm::vec3(kBackside), glm::vec3(kBackside)};
    const PixelMix mix = pixelsAt(texels, hit);
    const PreviewPage& page = pages[mix.page];
    const auto width = static_cast<uint32_t>(texels.scan->pages[mix.page].image.width);
    const auto shrink = static_cast<uint32_t>(page.shrink);
    Columns columns{};
    for (size_t k = 0; k < 4; ++k) {
        const size_t small =
            size_t{mix.pixel[k] / width / shrink} * static_cast<size_t>(page.size.width) +
            mix.pixel[k] % width / shrink;
        columns[0] += mix.weight[k] * rgbAt(page.scanned, small);
        columns[1] += mix.weight[k] * rgbAt(page.albedo, small);
        columns[2] += mix.weight[k] * rgbAt(page.shading, small);
    }
    return columns;
}

/// Linear pixels of one camera's row, the three pictures side by side.
void renderRow(const Texels& texels, const RayScene& scene, const std::vector<PreviewPage>& pages,
               const Camera& camera, int y, glm::vec3* row)
{
    RowOfRays rays;
    lookAlong(y, kSamples, CameraRays(camera, {kWidth, kHeight}), scene, rays,
              [&](size_t x, const Ray&, const Hit& hit) {
                  const Columns columns = look(texels, pages, hit);
                  for (size_t c = 0; c < kColumns; ++c)
                      row[c * kWidth + x] += columns[c] / static_cast<float>(kSamples);
              });
}

/// What the shading is divided by to be shown.
float whiteOfShading(const std::vector<glm::vec3>& linear)
{
    std::vector<float> values;
    for (size_t i = 0; i < linear.size(); ++i)
        if (i % kRow >= kShadingColumn) values.push_back(linear[i].g);
    const auto at =
        values.begin() + static_cast<ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return std::max(1.0f, *at);
}

} // namespace

PreviewPage previewOf(const Page& page, const PageLayers& layers)
{
    PreviewPage preview;
    const int longest = std::max(layers.width, layers.height);
    preview.shrink = page.ofVertices ? 1 : (longest + kLongestSide - 1) / kLongestSide;
    preview.size = {(layers.width + preview.shrink - 1) / preview.shrink,
                    (layers.height + preview.shrink - 1) / preview.shrink};
    const auto width = static_cast<size_t>(preview.size.width);
    const auto height = static_cast<size_t>(preview.size.height);
    for (auto* layer : {&preview.scanned, &preview.albedo, &preview.shading})
        layer->resize(3 * width * height);
    const Radiance radiance(page.image);
    forEach(height, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            const size_t pixel = y * width + x;
            put(preview.scanned, pixel,
                meanOf(layers, preview, x, y, [&](size_t i) { return radiance[i]; }));
            put(preview.albedo, pixel,
                meanOf(layers, preview, x, y, [&](size_t i) { return rgbAt(layers.albedo, i); }));
            put(preview.shading, pixel, meanOf(layers, preview, x, y, [&](size_t i) {
                    return rgbAt(layers.direct, i) + rgbAt(layers.indirect, i);
                }));
        }
    });
    return preview;
}

PreviewPicture renderPreview(const Texels& texels, const RayScene& scene,
                             const std::vector<PreviewPage>& pages,
                             const std::vector<Camera>& cameras, const Progress& progress)
{
    const size_t rows = cameras.size() * kHeight;
    std::vector<glm::vec3> linear(rows * kRow, glm::vec3(0.0f));
    forEach(rows, [&](size_t row) {
        renderRow(texels, scene, pages, cameras[row / kHeight], static_cast<int>(row % kHeight),
                  &linear[row * kRow]);
        progress.check();
    });
    const float white = whiteOfShading(linear);
    static const SrgbFromHalf srgb;
    PreviewPicture picture{{static_cast<int>(kRow), static_cast<int>(rows)},
                           std::vector<uint8_t>(3 * linear.size())};
    forEachChunk(linear.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const float scale = i % kRow >= kShadingColumn ? 1.0f / white : 1.0f;
            for (int c = 0; c < 3; ++c)
                picture.rgb[3 * i + static_cast<size_t>(c)] =
                    srgb(halfFromFloat(scale * linear[i][c]));
        }
    });
    return picture;
}

} // namespace relamp
