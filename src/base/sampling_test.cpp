#include "base/sampling.shared.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kMany = 4096;

vec2 pointAt(int i)
{
    return evenPoint(static_cast<float>(i), vec2(0.25f, 0.5f));
}

} // namespace

// Density cos / pi: the mean cosine is the integral of cos^2 / pi over the half sphere, 2/3. With
// an even density it would be 1/2.
TEST(Sampling, CosineDirectionsAreDenseWhereTheCosineIs)
{
    for (const vec3 normal : {vec3(0, 0, 1), vec3(0, 0, -1), normalize(vec3(1, -2, 0.5f))}) {
        vec3 sum(0.0f);
        for (int i = 0; i < kMany; ++i) {
            const vec3 way = cosineDirection(normal, pointAt(i));
            EXPECT_NEAR(dot(way, way), 1.0f, 1e-5f);
            EXPECT_GE(dot(way, normal), -1e-6f);
            sum += way;
        }
        const vec3 mean = sum / static_cast<float>(kMany);
        EXPECT_LT(distance(mean, 2.0f / 3.0f * normal), 2e-3f);
    }
}

TEST(Sampling, CircleIsThatOfSineAndCosine)
{
    for (int i = 0; i <= kMany; ++i) {
        const float turn = static_cast<float>(i) / static_cast<float>(kMany);
        const double angle = 6.283185307179586 * static_cast<double>(turn);
        EXPECT_NEAR(static_cast<double>(onCircle(turn).x), std::cos(angle), 3e-7);
        EXPECT_NEAR(static_cast<double>(onCircle(turn).y), std::sin(angle), 3e-7);
    }
}

TEST(Sampling, EvenDirectionsGoEverywhereAlike)
{
    vec3 sum(0.0f);
    vec3 squares(0.0f);
    for (int i = 0; i < kMany; ++i) {
        const vec3 way = evenDirection(pointAt(i));
        sum += way;
        squares += way * way;
    }
    EXPECT_LT(length(sum) / kMany, 2e-3f);
    EXPECT_LT(distance(squares / static_cast<float>(kMany), vec3(1.0f / 3.0f)), 2e-3f);
}

// As many points in a part of the square as the part is large, to within a few.
TEST(Sampling, EvenPointsFillTheSquareAtAnyLength)
{
    for (const int count : {16, 64, 1000}) {
        int inside = 0;
        for (int i = 0; i < count; ++i) {
            const vec2 point = pointAt(i);
            inside += point.x < 0.5f && point.y < 0.3f ? 1 : 0;
        }
        EXPECT_NEAR(inside, 0.15 * count, 3.0);
    }
}

TEST(Sampling, ShiftsAreInRangeAndDifferByIndexAndSalt)
{
    double sum = 0.0;
    for (uint i = 0; i < kMany; ++i) {
        const float shift = hashedShift(i, 1);
        EXPECT_GE(shift, 0.0f);
        EXPECT_LT(shift, 1.0f);
        EXPECT_NE(shift, hashedShift(i, 2));
        sum += static_cast<double>(shift);
    }
    EXPECT_NEAR(sum / kMany, 0.5, 0.02);
}

} // namespace relamp
