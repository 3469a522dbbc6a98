#include "output/camera_plot.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{
namespace
{

constexpr int kPlotSide = 132;    // pixels
constexpr int kPlotMargin = 10;   // around it
constexpr float kStops = 8.0f;    // along each side
constexpr float kGrid = 2.0f;     // stops from line to line
constexpr float kHalfLine = 1.2f; // pixels, half of a line's

constexpr glm::vec3 kPaper(24.0f); // sRGB, 0..255
constexpr glm::vec3 kLine(70.0f);
constexpr glm::vec3 kStraight(150.0f);
constexpr glm::vec3 kCurve(245.0f);
constexpr glm::vec3 kAmber(214.0f, 148.0f, 52.0f);

/// By how many stops a place is shifted at least and at most.
struct Shift
{
    float least = 0.0f;
    float most = 0.0f;
};

Shift shiftOf(const Gain& gain)
{
    if (gain.isOne()) return {};
    Shift shift{1e9f, -1e9f};
    for (const glm::vec3 log : gain.log) {
        const float stops = std::log2(luminance(glm::exp(log)));
        shift.least = std::min(shift.least, stops);
        shift.most = std::max(shift.most, stops);
    }
    return shift;
}

/// The plot's pixels: stops of the texture along x, of radiance along y, both 0 at white.
class Plot
{
public:
    explicit Plot(const CameraModel& camera) : response_(camera.response)
    {
        const Shift tone = shiftOf(camera.tone.gain);
        for (const Gain& room : camera.gains) {
            const Shift gain = shiftOf(room);
            shift_ = {std::min(shift_.least, gain.least), std::max(shift_.most, gain.most)};
        }
        shift_ = {tone.least + shift_.least, tone.most + shift_.most};
    }

    [[nodiscard]] glm::vec3 operator()(int column, int row) const
    {
        constexpr float kPerPixel = kStops / static_cast<float>(kPlotSide - 1);
        const float texture = static_cast<float>(column) * kPerPixel - kStops;
        const float radiance = -static_cast<float>(row) * kPerPixel;
        const float curve = std::log2(response_(std::exp2(texture)));
        const float slope =
            (curve - std::log2(response_(std::exp2(texture - kPerPixel)))) / kPerPixel;
        glm::vec3 colour = kPaper;
        const auto draw = [&](float off, glm::vec3 ink, float width) { // off in pixels
            colour = glm::mix(colour, ink, std::clamp(width + 0.5f - std::abs(off), 0.0f, 1.0f));
        };
        for (const float at : {texture, radiance})
            draw((at - kGrid * std::round(at / kGrid)) / kPerPixel, kLine, 0.3f);
        // Where the gain is above 1 the camera showed less light than elsewhere as so much.
        if (radiance <= curve - shift_.least && radiance >= curve - shift_.most)
            colour = glm::mix(colour, kAmber, 0.7f);
        draw((radiance - texture) / kPerPixel / std::sqrt(2.0f), kStraight, 0.4f);
        draw((radiance - curve) / kPerPixel / std::sqrt(1.0f + slope * slope), kCurve, kHalfLine);
        return colour;
    }

private:
    const Response& response_;
    Shift shift_;
};

} // namespace

void drawCamera(const CameraModel& camera, PreviewPicture& picture)
{
    if (camera.isNeutral()) return;
    const int bottom = std::min(PreviewPicture::kRowHeight, picture.size.height) - kPlotMargin;
    if (picture.size.width < kPlotSide + 2 * kPlotMargin || bottom < kPlotSide + kPlotMargin)
        return;
    const Plot plot(camera);
    for (int row = 0; row < kPlotSide; ++row)
        for (int column = 0; column < kPlotSide; ++column) {
            const glm::vec3 colour = plot(column, row);
            const auto y = static_cast<size_t>(bottom - kPlotSide + row);
            const auto x = static_cast<size_t>(kPlotMargin + column);
            uint8_t* rgb = &picture.rgb[3 * (y * static_cast<size_t>(picture.size.width) + x)];
            for (int c = 0; c < 3; ++c) rgb[c] = static_cast<uint8_t>(std::lround(colour[c]));
        }
}

} // namespace relamp
