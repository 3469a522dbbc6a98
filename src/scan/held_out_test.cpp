#include "scan/held_out.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace relamp
{

TEST(HeldOut, FoldsAreFifthsOfSpace)
{
    constexpr int kAcross = 40; // cubes, along each side
    for (const uint32_t seed : {1u, 2u, 77u}) {
        std::array<int, kFolds> count{};
        for (int i = 0; i < kAcross * kAcross * kAcross; ++i) {
            const glm::vec3 at(i % kAcross, i / kAcross % kAcross, i / (kAcross * kAcross));
            ++count.at(static_cast<size_t>(foldOf(0.25f * at - 5.0f, seed)));
        }
        for (const int of : count)
            EXPECT_NEAR(static_cast<double>(of) / (kAcross * kAcross * kAcross), 0.2, 0.02);
    }
}

// Of 2.5 m along a wall no fold has more than a fifth, nor two cubes side by side, wherever it
// begins.
TEST(HeldOut, FoldsLieApart)
{
    for (const uint32_t seed : {1u, 2u, 77u})
        for (int row = 0; row < 100; ++row) {
            std::array<int, kFolds> count{};
            int inOne = 0; // without a change
            int most = 0;
            int before = -1;
            for (int i = 0; i < 1000; ++i) {
                const int fold = foldOf({0.37f + 2.5e-3f * static_cast<float>(i), 0.2f,
                                         0.13f * static_cast<float>(row)},
                                        seed);
                ++count.at(static_cast<size_t>(fold));
                inOne = fold == before ? inOne + 1 : 1;
                most = std::max(most, inOne);
                before = fold;
            }
            for (const int of : count) EXPECT_NEAR(of, 200, 1);
            EXPECT_LE(most, 101); // 0.25 m
        }
}

TEST(HeldOut, FoldsAreOthersUnderAnotherSeed)
{
    int same = 0;
    for (int i = 0; i < 2500; ++i) {
        const glm::vec3 place(0.5f * static_cast<float>(i % 50), 0.2f,
                              0.5f * static_cast<float>(i / 50));
        same += foldOf(place, 1) == foldOf(place, 2) ? 1 : 0;
    }
    EXPECT_NEAR(same / 2500.0, 0.2, 0.07);
}

} // namespace relamp
