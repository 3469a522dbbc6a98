#include "image/view_transform.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr View kViews[] = {View::standard, View::agx, View::aces};

} // namespace

TEST(ViewTransform, StandardIsTheLightItselfUpToWhite)
{
    const ViewTransform view({});
    EXPECT_EQ(view.displayed({0.25f, 0.5f, 3.0f}), glm::vec3(0.25f, 0.5f, 1.0f));
}

TEST(ViewTransform, AStopIsTwiceTheLight)
{
    for (const View view : kViews) {
        const glm::vec3 brighter =
            ViewTransform({.view = view, .exposure = 1.0f}).displayed({0.1f, 0.2f, 0.05f});
        EXPECT_EQ(brighter, ViewTransform({.view = view}).displayed({0.2f, 0.4f, 0.1f}));
    }
}

// More light never gives a darker grey, grey stays grey, nothing is black and enough is white.
TEST(ViewTransform, GreysRiseFromBlackToWhite)
{
    for (const View view : kViews) {
        const ViewTransform transform({.view = view});
        float before = transform.displayed(glm::vec3(0.0f)).g;
        EXPECT_LT(before, 0.002f);
        for (float light = 1e-5f; light < 1e5f; light *= 1.1f) {
            const glm::vec3 shown = transform.displayed(glm::vec3(light));
            EXPECT_GE(shown.g, before);
            EXPECT_NEAR(shown.r, shown.g, 2e-4f);
            EXPECT_NEAR(shown.b, shown.g, 2e-4f);
            before = shown.g;
        }
        EXPECT_GT(before, 0.97f);
    }
}

// AgX puts middle grey, 10 of its 16.5 stops up, at half of a display's range: 0.5^2.2.
TEST(ViewTransform, AgxPutsMiddleGreyInTheMiddle)
{
    const ViewTransform agx({.view = View::agx});
    EXPECT_NEAR(agx.displayed(glm::vec3(0.18f)).g, 0.2176f, 2e-3f);
}

// The reference rendering of ACES shows a grey card of 18 % as about 10 % of white.
TEST(ViewTransform, AcesShowsAGreyCardAsItsReferenceDoes)
{
    const ViewTransform aces({.view = View::aces});
    EXPECT_NEAR(aces.displayed(glm::vec3(0.18f)).g, 0.1056f, 1e-3f);
}

// What is far brighter than white loses its colour in AgX; cut off at white, it would be pure red.
TEST(ViewTransform, AgxFadesBrightColoursToWhite)
{
    const ViewTransform agx({.view = View::agx});
    const glm::vec3 dim = agx.displayed({0.3f, 0.03f, 0.03f});
    const glm::vec3 bright = agx.displayed({60.0f, 6.0f, 6.0f});
    EXPECT_LT(dim.g / dim.r, 0.35f);
    EXPECT_GT(bright.g / bright.r, 0.7f);
}

TEST(ViewTransform, WhateverComesItIsBetweenBlackAndWhite)
{
    for (const View view : kViews)
        for (const float light : {0.0f, 1e-30f, 1.0f, 1e20f, 3e38f}) {
            const glm::vec3 shown = ViewTransform({.view = view, .exposure = 32.0f})
                                        .displayed({light, 0.0f, 0.5f * light});
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(shown[c], 0.0f);
                EXPECT_LE(shown[c], 1.0f);
            }
        }
}

} // namespace relamp
