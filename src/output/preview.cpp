#include "output/preview.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/transfer.h"
#include "output/camera_rays.h"
#include "scan/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/gtc/type_ptr.hpp>

namespace relamp
{
namespace
{

constexpr int kWidth = 640; // of one picture
constexpr int kHeight = PreviewPicture::kRowHeight;
constexpr int kColumns = 3;
constexpr size_t kRow = size_t{kColumns} * kWidth;
constexpr size_t kShadingColumn = kColumns - 1;
constexpr double kWhite = 0.95;          // quantile of the shading that is shown as white
constexpr int kSamples = 2;              // of a pixel
constexpr int kLongestSide = 2048;       // of a page in a preview
constexpr double kPagesOfFullSide = 4.0; // of more, each shows less of a room
constexpr float kNothing = 0.02f;        // where no surface is seen
constexpr float kBackside = 0.08f;       // where one is seen from behind

glm::vec3 rgbAt(const std::vector<uint16_t>& layer, size_t pixel)
{
    const uint16_t* rgb = &layer[3 * pixel];
    return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
}

void put(uint16_t* samples, glm::vec3 rgb)
{
    for (int c = 0; c < 3; ++c) samples[c] = halfFromFloat(rgb[c]);
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

/// One pixel of all three pictures: R, G, B of each.
using Columns = std::array<float, PreviewPage::kSamples>;

Columns grey(float value)
{
    Columns columns{};
    columns.fill(value);
    return columns;
}

Columns look(const Texels& texels, const std::vector<PreviewPage>& pages, const Hit& hit)
{
    if (hit.missed()) return grey(kNothing);
    if (!hit.front) return grey(kBackside);
    const PixelMix mix = pixelsAt(texels, hit);
    const PreviewPage& page = pages[mix.page];
    const auto width = static_cast<uint32_t>(texels.scan->pages[mix.page].image.width);
    const auto shrink = static_cast<uint32_t>(page.shrink);
    Columns columns{};
    for (size_t k = 0; k < 4; ++k) {
        const size_t small =
            size_t{mix.pixel[k] / width / shrink} * static_cast<size_t>(page.size.width) +
            mix.pixel[k] % width / shrink;
        const uint16_t* samples = &page.samples[PreviewPage::kSamples * small];
        for (size_t i = 0; i < columns.size(); ++i)
            columns[i] += mix.weight[k] * floatFromHalf(samples[i]);
    }
    return columns;
}

/// Linear pixels of one camera's row, the three pictures side by side.
void renderRow(const Texels& texels, const RayScene& scene, const std::vector<PreviewPage>& pages,
               const Camera& camera, int y, std::span<glm::vec3> row)
{
    RowOfRays rays;
    lookAlong(y, kSamples, CameraRays(camera, {kWidth, kHeight}), scene, rays,
              [&](size_t x, const Ray&, const Hit& hit) {
                  const Columns columns = look(texels, pages, hit);
                  for (size_t c = 0; c < kColumns; ++c)
                      row[c * kWidth + x] +=
                          glm::make_vec3(&columns[3 * c]) / static_cast<float>(kSamples);
              });
}

/// What the shading is divided by to be shown: its quantile where that is above 1.
float whiteOf(const std::vector<glm::vec3>& shading)
{
    std::vector<float> bright;
    for (const glm::vec3 light : shading)
        if (light.g > 1.0f) bright.push_back(light.g);
    const auto at = static_cast<size_t>(kWhite * static_cast<double>(shading.size() - 1));
    const size_t dark = shading.size() - bright.size();
    if (at < dark) return 1.0f;
    const auto white = bright.begin() + static_cast<ptrdiff_t>(at - dark);
    std::nth_element(bright.begin(), white, bright.end());
    return *white;
}

/// sRGB of linear pixels, which are multiplied by `scale`.
void develop(std::span<const glm::vec3> linear, float scale, uint8_t* rgb)
{
    static const SrgbFromHalf srgb;
    for (const glm::vec3 pixel : linear)
        for (int c = 0; c < 3; ++c) *rgb++ = srgb(halfFromFloat(scale * pixel[c]));
}

} // namespace

PreviewPage previewOf(const Page& page, const PageLayers& layers, size_t pages)
{
    PreviewPage preview;
    const int side =
        kLongestSide /
        static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pages) / kPagesOfFullSide)));
    const int longest = std::max(layers.width, layers.height);
    preview.shrink = page.ofVertices ? 1 : (longest + side - 1) / side;
    preview.size = {(layers.width + preview.shrink - 1) / preview.shrink,
                    (layers.height + preview.shrink - 1) / preview.shrink};
    const auto width = static_cast<size_t>(preview.size.width);
    const auto height = static_cast<size_t>(preview.size.height);
    preview.samples.resize(PreviewPage::kSamples * width * height);
    const Radiance radiance(page.image);
    forEach(height, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            uint16_t* samples = &preview.samples[PreviewPage::kSamples * (y * width + x)];
            put(samples, meanOf(layers, preview, x, y, [&](size_t i) { return radiance[i]; }));
            put(samples + 3,
                meanOf(layers, preview, x, y, [&](size_t i) { return rgbAt(layers.albedo, i); }));
            put(samples + 6, meanOf(layers, preview, x, y, [&](size_t i) {
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
    PreviewPicture picture{{static_cast<int>(kRow), static_cast<int>(rows)},
                           std::vector<uint8_t>(3 * rows * kRow)};
    constexpr size_t kBefore = kShadingColumn * kWidth; // of a row, pixels
    std::vector<glm::vec3> shading(rows * kWidth);
    forEach(rows, [&](size_t y) {
        std::vector<glm::vec3> row(kRow, glm::vec3(0.0f));
        renderRow(texels, scene, pages, cameras[y / kHeight], static_cast<int>(y % kHeight), row);
        develop(std::span(row).first(kBefore), 1.0f, &picture.rgb[3 * y * kRow]);
        std::copy(row.begin() + kBefore, row.end(), &shading[y * kWidth]);
        progress.check();
    });
    const float scale = 1.0f / whiteOf(shading);
    forEach(rows, [&](size_t y) {
        develop(std::span(shading).subspan(y * kWidth, kWidth), scale,
                &picture.rgb[3 * (y * kRow + kBefore)]);
    });
    return picture;
}

} // namespace relamp
