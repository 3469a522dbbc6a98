#include "output/camera_plot.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kPlotted = 132;
constexpr int kPlotLeft = 10;
constexpr int kPlotBottom = 390; // the row below the last

PreviewPicture blank()
{
    return {{1920, 400}, std::vector<uint8_t>(size_t{3} * 1920 * 400, 7)};
}

PreviewPicture plotOf(const CameraModel& camera)
{
    PreviewPicture picture = blank();
    drawCamera(camera, picture);
    return picture;
}

/// Green of the pixel for a texture and a radiance, stops below white.
int at(const PreviewPicture& picture, float texture, float radiance)
{
    const auto pixel = [](float stops) {
        return static_cast<int>(std::lround(stops / 8.0f * (kPlotted - 1)));
    };
    const int x = kPlotLeft + kPlotted - 1 - pixel(texture);
    const int y = kPlotBottom - kPlotted + pixel(radiance);
    return picture.rgb[3 * (static_cast<size_t>(y) * 1920 + static_cast<size_t>(x)) + 1];
}

} // namespace

TEST(CameraPlot, OfACameraThatDidNothingIsNone)
{
    EXPECT_EQ(plotOf({}).rgb, blank().rgb);
}

// A slope of 1/2 makes 6 stops of the texture 3 of light.
TEST(CameraPlot, ShowsTheResponseBesideAStraightOne)
{
    CameraModel camera;
    camera.response.slope.fill(0.5f);
    const PreviewPicture picture = plotOf(camera);
    for (const float texture : {1.0f, 3.0f, 5.0f, 7.0f}) {
        EXPECT_GT(at(picture, texture, 0.5f * texture), 200);
        EXPECT_GT(at(picture, texture, texture), 90); // the grey diagonal
        EXPECT_LT(at(picture, texture, 0.5f * texture), 256);
    }
    EXPECT_LT(at(picture, 7.0f, 5.1f), 90); // between them
}

// A gain of a stop either way makes a band of two stops of a curve that is straight.
TEST(CameraPlot, ShowsHowFarTheGainShiftsIt)
{
    CameraModel camera;
    camera.gains.resize(1);
    camera.gains[0].count = {2, 1, 1};
    camera.gains[0].log = {glm::vec3(std::log(2.0f)), glm::vec3(-std::log(2.0f))};
    const PreviewPicture picture = plotOf(camera);
    EXPECT_GT(at(picture, 3.1f, 3.8f), 90);
    EXPECT_GT(at(picture, 3.1f, 2.4f), 90);
    EXPECT_LT(at(picture, 3.1f, 5.1f), 60);
    EXPECT_LT(at(picture, 3.1f, 1.3f), 60);
}

TEST(CameraPlot, StaysInItsCorner)
{
    CameraModel camera;
    camera.response.slope.fill(0.8f);
    const PreviewPicture picture = plotOf(camera);
    const std::vector<uint8_t> before = blank().rgb;
    size_t drawn = 0;
    for (size_t i = 0; i < before.size(); i += 3) {
        const size_t x = i / 3 % 1920;
        const size_t y = i / 3 / 1920;
        const bool isInside = x >= 10 && x < 142 && y >= 258 && y < 390;
        if (isInside)
            ++drawn;
        else
            ASSERT_EQ(picture.rgb[i], before[i]);
    }
    EXPECT_EQ(drawn, size_t{kPlotted} * kPlotted);
}

} // namespace relamp
