#include "scenes/apart_layers.h"

#include "base/half.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace relamp::scenes
{

Apart apart(const std::vector<uint16_t>& ofGpu, const std::vector<uint16_t>& ofCpu)
{
    EXPECT_EQ(ofGpu.size(), ofCpu.size());
    Apart apart(0.02f);
    for (size_t i = 0; i + 2 < ofCpu.size(); i += 3)
        apart.add(
            {floatFromHalf(ofGpu[i]), floatFromHalf(ofGpu[i + 1]), floatFromHalf(ofGpu[i + 2])},
            {floatFromHalf(ofCpu[i]), floatFromHalf(ofCpu[i + 1]), floatFromHalf(ofCpu[i + 2])});
    return apart;
}

void expectAlike(const PageLayers& ofGpu, const PageLayers& ofCpu)
{
    for (const auto layer : {&PageLayers::albedo, &PageLayers::direct, &PageLayers::indirect}) {
        const Apart far = apart(ofGpu.*layer, ofCpu.*layer);
        EXPECT_LT(far.beyond(5e-3f), 1e-3);
        EXPECT_LT(far.beyond(0.02f), 1e-4);
    }
    EXPECT_EQ(ofGpu.emission, ofCpu.emission);
    ASSERT_EQ(ofGpu.confidence.size(), ofCpu.confidence.size());
    size_t apart = 0;
    size_t otherDoubts = 0;
    for (size_t i = 0; i < ofCpu.confidence.size(); ++i) {
        apart += std::abs(ofGpu.confidence[i] - ofCpu.confidence[i]) > 3 ? 1u : 0u;
        otherDoubts += ofGpu.doubt[i] != ofCpu.doubt[i] ? 1u : 0u;
    }
    const auto pixels = static_cast<double>(ofCpu.confidence.size());
    EXPECT_LT(static_cast<double>(apart), 2e-3 * pixels);
    EXPECT_LT(static_cast<double>(otherDoubts), 2e-3 * pixels);
    double area = 0.0;
    for (const double ofDoubt : ofCpu.area) area += ofDoubt;
    for (size_t d = 0; d < kDoubts; ++d) EXPECT_NEAR(ofGpu.area[d], ofCpu.area[d], 2e-3 * area);
}

} // namespace relamp::scenes
