#include "fit/light_fit.h"

#include "base/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Places of one albedo that see a dark room, small holes and an opening, each in another mixture.
LightModel placesBeside(float holes, float opening)
{
    constexpr size_t kPlaces = 400;
    LightModel model{.outsides = 2};
    Random random(1, 1, 1);
    for (size_t i = 0; i < kPlaces; ++i) {
        const float gathered = 0.2f + 0.6f * random.next();
        const float small = 0.1f * random.next();
        const float large = random.next();
        const float all = gathered + holes * small + opening * large;
        model.direct.emplace_back();
        model.gathered.emplace_back(gathered);
        model.missed.push_back({{0, small}, {1, large}});
        model.shown.emplace_back(0.4f / kPi * all);
    }
    return model;
}

std::vector<MaterialPair> pairsOf(const LightModel& model)
{
    std::vector<MaterialPair> pairs;
    const auto places = static_cast<uint32_t>(model.places());
    for (uint32_t i = 0; i < places; ++i) {
        pairs.push_back({i, (i + 1) % places});
        pairs.push_back({i, (i + 7) % places});
    }
    return pairs;
}

std::vector<double> radianceOutside(const LightModel& model)
{
    const std::vector<MaterialPair> pairs = pairsOf(model);
    const LightFit fit(model, pairs, {}, 0.08);
    const LightEstimate estimate = fit.solve({}, fit.beginning(), 6.0);
    return {std::exp(estimate.log[0]), std::exp(estimate.log[1])};
}

} // namespace

// Small holes show what lies in shade though a window beside them shows the sky.
TEST(LightFit, OpeningHasARadianceOfItsOwn)
{
    const std::vector<double> bright = radianceOutside(placesBeside(0.05f, 8.0f));
    EXPECT_NEAR(bright[1], 8.0, 0.8);
    EXPECT_LT(bright[0], 0.8);
    EXPECT_NEAR(radianceOutside(placesBeside(0.05f, 0.1f))[1], 0.1, 0.03);
}

// Nothing is seen through either: both are as bright as what scanners miss is.
TEST(LightFit, OpeningsThatNothingTellsOfAreAlike)
{
    LightModel model = placesBeside(0.0f, 0.0f);
    model.missed.assign(model.missed.size(), {});
    const std::vector<double> outside = radianceOutside(model);
    EXPECT_NEAR(outside[0], outside[1], 1e-3 * outside[0]);
}

} // namespace relamp
