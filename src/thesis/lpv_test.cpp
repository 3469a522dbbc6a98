#include "thesis/lpv.h"

#include "thesis/lpv.shared.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kSize = 24;

/// Twenty-four cells of one metre along each side, nothing in them.
Lpv emptySpace()
{
    return Lpv(LpvGrid({glm::vec3(0.0f), glm::vec3(kSize)}, kSize));
}

BounceLight lightAt(glm::vec3 position, glm::vec3 normal, float flux = 1.0f)
{
    // Injection moves a light half a cell along its normal; take that back to stay in the cell
    // meant.
    return {.position = position - 0.5f * normal, .normal = normal, .flux = glm::vec3(flux)};
}

double sum(const std::vector<float>& values)
{
    double total = 0.0;
    for (const float v : values) total += static_cast<double>(v);
    return total;
}

const glm::vec3 kMiddle(kSize / 2 + 0.5f);

/// Across the middle, half as dense as what stops all light.
std::vector<Blocker> wallOfBlockers()
{
    std::vector<Blocker> wall;
    for (int y = 0; y < kSize; ++y)
        for (int z = 0; z < kSize; ++z)
            wall.push_back({kMiddle + glm::vec3(0.0f, y - kSize / 2, z - kSize / 2),
                            glm::vec3(1.0f, 0.0f, 0.0f), 0.5f});
    return wall;
}

} // namespace

TEST(Lpv, SolidAnglesOfOneFrontAndFourSideFacesAreASixthOfTwoSpheres)
{
    EXPECT_NEAR(kFrontSolidAngle + 4.0f * kSideSolidAngle, 2.0f * kPi / 3.0f, 1e-6f);
}

// Six neighbours see the whole sphere between them and lobes hold what they are given, so light
// that is the same in all directions is passed on without gain or loss.
TEST(Lpv, IsotropicLightKeepsItsEnergyEveryStep)
{
    Lpv lpv = emptySpace();
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        const BounceLight lights[] = {lightAt(kMiddle, axis), lightAt(kMiddle, -axis)};
        lpv.inject(lights);
    }
    const double before = sum(lpv.travelling()[0][0]);
    lpv.propagate(true);
    EXPECT_NEAR(sum(lpv.travelling()[0][0]) / before, 1.0, 1e-6);
}

// Once light no longer points backwards anywhere, clamping does nothing and energy stays.
TEST(Lpv, DirectedLightKeepsItsEnergyAfterTheFirstStep)
{
    Lpv lpv = emptySpace();
    lpv.inject({{lightAt(kMiddle, {1, 0, 0})}});
    lpv.propagate(true);
    const double before = sum(lpv.travelling()[0][0]);
    lpv.propagate(false);
    EXPECT_NEAR(sum(lpv.travelling()[0][0]) / before, 1.0, 0.01);
}

// The lobe of a surface is below zero behind it; clamping that to zero makes 13.8 % of light.
TEST(Lpv, FirstStepOfASurfaceMakesItsKnownGainByClamping)
{
    Lpv lpv = emptySpace();
    lpv.inject({{lightAt(kMiddle, {1, 0, 0})}});
    const double before = sum(lpv.travelling()[0][0]);
    lpv.propagate(true);
    EXPECT_NEAR(sum(lpv.travelling()[0][0]) / before, 1.138, 1e-3);
}

// Direction is lost as light is sent on through flat faces: the first band shrinks to 0.3686 a
// step.
TEST(Lpv, DirectionFadesByItsKnownFactorEveryStep)
{
    Lpv lpv = emptySpace();
    const BounceLight lights[] = {
        lightAt(kMiddle, {1, 0, 0}, 1.0f), lightAt(kMiddle, {-1, 0, 0}, 0.9f),
        lightAt(kMiddle, {0, 1, 0}, 2.0f), lightAt(kMiddle, {0, -1, 0}, 2.0f),
        lightAt(kMiddle, {0, 0, 1}, 2.0f), lightAt(kMiddle, {0, 0, -1}, 2.0f)};
    lpv.inject(lights); // nearly isotropic: nothing is clamped
    const double before = sum(lpv.travelling()[0][3]);
    lpv.propagate(true);
    EXPECT_NEAR(sum(lpv.travelling()[0][3]) / before, 0.3686, 1e-4);
}

TEST(Lpv, LightSpreadsAlikeToAllSixNeighbors)
{
    Lpv lpv = emptySpace();
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        const BounceLight lights[] = {lightAt(kMiddle, axis), lightAt(kMiddle, -axis)};
        lpv.inject(lights);
    }
    lpv.propagate(true);
    const LpvGrid& grid = lpv.grid();
    const glm::ivec3 home = grid.cellAt(kMiddle);
    const float first = lpv.travelling()[0][0][grid.indexOf(home + glm::ivec3(1, 0, 0))];
    EXPECT_GT(first, 0.0f);
    for (const glm::ivec3 step : {glm::ivec3(-1, 0, 0), glm::ivec3(0, 1, 0), glm::ivec3(0, -1, 0),
                                  glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)})
        EXPECT_NEAR(lpv.travelling()[0][0][grid.indexOf(home + step)], first, 1e-6f * first);
}

// A wall that fills a cell's face and looks at the light should stop it all; two bands hold max(0,
// cos) as 1/4 + 1/2 cos, which stops three quarters head on. (Kaplanyan's volumes leak; this says
// how much.)
TEST(Lpv, WallStopsThreeQuartersOfTheLightThatComesTowardsItsFace)
{
    const auto throughWall = [](float area) {
        Lpv lpv = emptySpace();
        std::vector<Blocker> wall;
        for (int y = 0; y < kSize; ++y)
            for (int z = 0; z < kSize; ++z)
                wall.push_back({{kMiddle.x + 1.5f, static_cast<float>(y) + 0.25f,
                                 static_cast<float>(z) + 0.25f},
                                {-1, 0, 0},
                                area});
        lpv.block(wall);
        lpv.inject({{lightAt(kMiddle, {1, 0, 0})}});
        for (int step = 0; step < 6; ++step) lpv.propagate(step == 0);
        double behind = 0.0;
        const LpvGrid& grid = lpv.grid();
        for (int z = 0; z < grid.cells.z; ++z)
            for (int y = 0; y < grid.cells.y; ++y)
                for (int x = grid.cellAt(kMiddle).x + 2; x < grid.cells.x; ++x)
                    behind += static_cast<double>(lpv.accumulated()[0][0][grid.indexOf({x, y, z})]);
        return behind;
    };
    EXPECT_NEAR(throughWall(1.0f) / throughWall(0.0f), 0.25, 0.05);
}

// Half a cell in front of a patch that sends out the flux F, the intensity towards a surface that
// faces it is F / pi, and it arrives over half a cell: E = F / pi / (cell / 2)^2. Two bands blur
// the lobe.
TEST(Lpv, ReadOutTurnsIntensityIntoIrradianceOverHalfACell)
{
    Lpv lpv(LpvGrid({glm::vec3(0.0f), glm::vec3(8.0f)}, 16)); // cells of half a metre
    const glm::vec3 middle(4.25f);
    BounceLight light = lightAt(middle, {1, 0, 0}, 2.0f);
    light.position = middle - glm::vec3(0.25f, 0, 0);
    lpv.inject({{light}});
    lpv.finish();
    TexelBlock block;
    block.count = 1;
    block.x[0] = middle.x + 0.25f; // its cell's centre is where it looks
    block.y[0] = middle.y;
    block.z[0] = middle.z;
    block.nx[0] = -1.0f;
    RgbBlock irradiance;
    lpv.irradiance(block, irradiance);
    const float lobeOnLobe =
        kLobeC0 * kLobeC0 + kLobeC1 * kLobeC1; // 1.83: two-band product of the lobes
    EXPECT_NEAR(irradiance.r[0], 2.0f / kPi * lobeOnLobe / (0.25f * 0.25f), 1e-3f);
}

TEST(Lpv, IsTheSameForAllInstructionSets)
{
    const auto run = [](InstructionSet set) {
        Lpv lpv = emptySpace();
        std::vector<BounceLight> lights;
        for (int i = 0; i < 100; ++i) {
            const auto f = static_cast<float>(i);
            lights.push_back(
                {.position = {2 + std::fmod(f * 1.7f, 20.0f), 3 + std::fmod(f * 2.3f, 18.0f),
                              4 + std::fmod(f, 16.0f)},
                 .normal = glm::normalize(glm::vec3(std::sin(f), std::cos(f), std::sin(2 * f))),
                 .flux = {1.0f, 0.5f, 0.1f * f}});
        }
        lpv.block(wallOfBlockers());
        lpv.inject(lights);
        for (int step = 0; step < 4; ++step) lpv.propagate(step == 0, set);
        return lpv.accumulated();
    };
    const Lpv::Field narrow = run(InstructionSet::baseline);
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
        if (set > bestInstructionSet()) continue;
        const Lpv::Field wide = run(set);
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < 4; ++k)
                for (size_t i = 0; i < narrow[c][k].size(); ++i)
                    EXPECT_NEAR(wide[c][k][i], narrow[c][k][i],
                                1e-5f * std::abs(narrow[c][0][i]) + 1e-9f);
    }
}

// A row of five cells is worked on in another way than one of twenty-four.
TEST(Lpv, ARoomIsAsItIsTurned)
{
    const auto turned = [](glm::vec3 v) { return glm::vec3(v.z, v.y, v.x); };
    const glm::vec3 extent(5.0f, 24.0f, 24.0f);
    Lpv thin(LpvGrid({glm::vec3(0.0f), extent}, 24));
    Lpv wide(LpvGrid({glm::vec3(0.0f), turned(extent)}, 24));
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 0.2f, -0.9f));
    const BounceLight light{
        .position = {2.4f, 11.2f, 12.8f}, .normal = normal, .flux = {1.0f, 0.5f, 0.2f}};
    const Blocker blocker{{3.5f, 11.5f, 10.5f}, {0.0f, 0.0f, 1.0f}, 0.6f};
    BounceLight turnedLight = light;
    turnedLight.position = turned(light.position);
    turnedLight.normal = turned(normal);
    thin.block({{blocker}});
    wide.block({{{turned(blocker.position), turned(blocker.normal), blocker.area}}});
    thin.inject({{light}});
    wide.inject({{turnedLight}});
    for (int step = 0; step < 4; ++step) {
        thin.propagate(step == 0);
        wide.propagate(step == 0);
    }
    constexpr size_t kTurned[] = {0, 1, 3, 2}; // of (1, -y, z, -x), the last two with another sign
    const glm::ivec3 cells = thin.grid().cells;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x)
                for (size_t k = 0; k < 4; ++k)
                    ASSERT_NEAR(
                        thin.accumulated()[0][k][thin.grid().indexOf({x, y, z})],
                        (k < 2 ? 1.0f : -1.0f) *
                            wide.accumulated()[0][kTurned[k]][wide.grid().indexOf({z, y, x})],
                        1e-6f)
                        << x << ' ' << y << ' ' << z << ' ' << k;
    EXPECT_GT(sum(thin.accumulated()[0][0]), 0.1);
}

} // namespace relamp
