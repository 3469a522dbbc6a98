#include "fit/held_out.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Share of a cube of 10 m.
double shareOf(const HeldOut& heldOut)
{
    constexpr int kPlaces = 40; // along each side, in steps of a cube
    int count = 0;
    for (int i = 0; i < kPlaces * kPlaces * kPlaces; ++i) {
        const glm::vec3 at(i % kPlaces, i / kPlaces % kPlaces, i / (kPlaces * kPlaces));
        count += heldOut.has(0.25f * at - 5.0f) ? 1 : 0;
    }
    return static_cast<double>(count) / (kPlaces * kPlaces * kPlaces);
}

} // namespace

TEST(HeldOut, IsAFifthOfSpace)
{
    for (const uint32_t seed : {1u, 2u, 77u}) EXPECT_NEAR(shareOf(HeldOut(seed)), 0.2, 0.02);
}

// Of 2.5 m along a wall no more than a fifth, wherever it begins.
TEST(HeldOut, LiesApart)
{
    for (const uint32_t seed : {1u, 2u, 77u}) {
        const HeldOut heldOut(seed);
        for (int row = 0; row < 100; ++row) {
            int held = 0;
            int inOne = 0; // without a gap
            int most = 0;
            for (int i = 0; i < 1000; ++i) {
                const glm::vec3 place(0.37f + 2.5e-3f * static_cast<float>(i), 0.2f,
                                      0.13f * static_cast<float>(row));
                inOne = heldOut.has(place) ? inOne + 1 : 0;
                held += heldOut.has(place) ? 1 : 0;
                most = std::max(most, inOne);
            }
            EXPECT_NEAR(held, 200, 1);
            EXPECT_LE(most, 101); // 0.25 m
        }
    }
}

TEST(HeldOut, IsAnotherFifthUnderAnotherSeed)
{
    const HeldOut one(1);
    const HeldOut other(2);
    int both = 0;
    int ofOne = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 place(0.5f * static_cast<float>(i % 50), 0.2f,
                              0.5f * static_cast<float>(i / 50));
        ofOne += one.has(place) ? 1 : 0;
        both += one.has(place) && other.has(place) ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(both) / ofOne, 0.2, 0.07);
}

} // namespace relamp
