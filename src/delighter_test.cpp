#include "relamp/delighter.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "relamp/error.h"
#include "scenes/apart_layers.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/many_lamps.h"
#include "scenes/sun_room.h"

#include <functional>
#include <limits>
#include <optional>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

DelightOptions draft()
{
    DelightOptions options;
    options.gather.quality = Quality::draft;
    return options;
}

DelightOptions thesisSolver()
{
    return {.solver = Solver::thesis};
}

PageLayers layersOf(const Decomposition& result)
{
    Progress progress;
    return result.layers(0, progress);
}

void expectSame(const Decomposition& a, const Decomposition& b)
{
    EXPECT_EQ(lightsAsJson(a.lights()), lightsAsJson(b.lights()));
    EXPECT_EQ(a.closure().rmsError, b.closure().rmsError);
    EXPECT_EQ(a.warnings(), b.warnings());
    const PageLayers first = layersOf(a);
    const PageLayers second = layersOf(b);
    EXPECT_EQ(first.albedo, second.albedo);
    EXPECT_EQ(first.direct, second.direct);
    EXPECT_EQ(first.indirect, second.indirect);
    EXPECT_EQ(first.emission, second.emission);
    EXPECT_EQ(first.confidence, second.confidence);
    EXPECT_EQ(first.doubt, second.doubt);
    EXPECT_EQ(first.area, second.area);
}

double sumOf(const std::vector<uint16_t>& halves)
{
    double sum = 0.0;
    for (const uint16_t half : halves) sum += static_cast<double>(floatFromHalf(half));
    return sum;
}

ErrorCode codeOf(const std::function<void()>& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "nothing was thrown";
    return ErrorCode::cannotRead;
}

/// A room that is solved and can be re-evaluated.
struct Room
{
    explicit Room(Scan of) : scan(std::move(of)), delighter(scenes::copyOf(scan))
    {
        found.emplace(delighter.solve(draft(), progress));
    }

    [[nodiscard]] Decomposition reevaluate(const Lights& lights)
    {
        return delighter.reevaluate(lights, draft().albedo, progress);
    }

    Scan scan;
    Delighter delighter;
    Progress progress;
    std::optional<Decomposition> found;
};

Lights brighter(Lights lights, float factor)
{
    for (Fixture& fixture : lights.fixtures) fixture.radiance *= factor;
    return lights;
}

} // namespace

TEST(Delighter, SolvesAsDelightDoesWhateverItSolvedBefore)
{
    Room room(scenes::LitRoom().scan);
    expectSame(*room.found, delight(scenes::copyOf(room.scan), draft(), room.progress));

    DelightOptions other = draft();
    other.gather.notLights = {scenes::LitRoom::kSheetCentre};
    other.gather.shadowRays = 4;
    other.gather.seed = 2;
    expectSame(room.delighter.solve(other, room.progress),
               delight(scenes::copyOf(room.scan), other, room.progress));

    other.albedo.fill = true;
    other.albedo.darkest = 0.1f;
    expectSame(room.delighter.solve(other, room.progress),
               delight(scenes::copyOf(room.scan), other, room.progress));
    expectSame(room.delighter.solve(draft(), room.progress), *room.found);
}

TEST(Delighter, ParametersOfTheThesisAreThoseOfDelight)
{
    const Scan scan = scenes::LitRoom().scan;
    Progress progress;
    Delighter delighter(scenes::copyOf(scan));
    DelightOptions options = thesisSolver();
    const Decomposition first = delighter.solve(options, progress);
    const PageLayers before = layersOf(first);
    const std::function<void()> parameters[] = {[&] { options.thesis.power = 2.0f; },
                                                [&] { options.thesis.lpvSteps = 3; },
                                                [&] { options.thesis.flattenRange = 1.0f; },
                                                [&] { options.thesis.lightLevels = 3; },
                                                [&] { options.thesis.emitterThreshold = 0.5f; },
                                                [&] { options.thesis.useLpv = false; }};
    for (const auto& turn : parameters) {
        turn();
        expectSame(delighter.solve(options, progress),
                   delight(scenes::copyOf(scan), options, progress));
    }
    EXPECT_EQ(layersOf(first).albedo, before.albedo);
}

TEST(Delighter, TheSameLightsGiveTheSameRoom)
{
    Room room(scenes::LitRoom().scan);
    const Lights& lights = room.found->lights();
    ASSERT_EQ(lights.fixtures.size(), 1u);
    expectSame(room.reevaluate(lights), *room.found);

    const PageLayers before = layersOf(*room.found);
    const Decomposition other = room.reevaluate(brighter(lights, 1.1f)); // not clearly wrong
    EXPECT_NEAR(sumOf(layersOf(other).direct) / sumOf(before.direct), 1.1, 0.005);
    EXPECT_LT(sumOf(layersOf(other).albedo), 0.98 * sumOf(before.albedo));
    EXPECT_FLOAT_EQ(other.lights().fixtures[0].radiance.r, 1.1f * lights.fixtures[0].radiance.r);
    EXPECT_EQ(other.lights().fixtures[0].error, glm::vec3(0.0f)); // somebody said so
    EXPECT_EQ(layersOf(*room.found).albedo, before.albedo);

    expectSame(room.reevaluate(lights), *room.found);
}

TEST(Delighter, ResultsOutliveIt)
{
    const Scan scan = scenes::LitRoom().scan;
    std::optional<Decomposition> found;
    std::optional<Decomposition> reevaluated;
    {
        Delighter delighter(scenes::copyOf(scan));
        Progress progress;
        found.emplace(delighter.solve(draft(), progress));
        reevaluated.emplace(
            delighter.reevaluate(brighter(found->lights(), 0.5f), draft().albedo, progress));
        static_cast<void>(delighter.solve(thesisSolver(), progress)); // which needs other texels
    }
    EXPECT_GT(sumOf(layersOf(*reevaluated).albedo), sumOf(layersOf(*found).albedo));
}

TEST(Delighter, ALampThatIsOffIsWall)
{
    Room room(scenes::LitRoom().scan);
    const PageLayers found = layersOf(*room.found);
    EXPECT_FALSE(found.emission.empty());
    const PageLayers dark = layersOf(room.reevaluate(brighter(room.found->lights(), 0.0f)));
    EXPECT_TRUE(dark.emission.empty());
    EXPECT_EQ(sumOf(dark.direct), 0.0);
    EXPECT_EQ(dark.area[static_cast<size_t>(Doubt::shines)], 0.0);
}

TEST(Delighter, TheSunIsALampToo)
{
    Room room(scenes::SunRoom(glm::vec3(3.0f)).scan);
    Lights lights = room.found->lights();
    ASSERT_TRUE(lights.sun);
    expectSame(room.reevaluate(lights), *room.found);

    lights.sun->irradiance *= 0.5f;
    lights.ambient += glm::vec3(0.1f);
    const Decomposition dimmed = room.reevaluate(lights);
    EXPECT_EQ(lightsAsJson(dimmed.lights()), lightsAsJson(lights));
    EXPECT_LT(sumOf(layersOf(dimmed).direct), sumOf(layersOf(*room.found).direct));
    expectSame(room.reevaluate(room.found->lights()), *room.found);
}

TEST(Delighter, LampsOfAGroupGetTheirMean)
{
    Room room(scenes::ManyLamps(14, 7).scan);
    Lights lights = room.found->lights();
    ASSERT_GT(lights.fixtures.size(), 96u); // else every one stays by itself
    expectSame(room.reevaluate(lights), *room.found);

    lights.fixtures[0].radiance *= 3.0f;
    const Decomposition reevaluated = room.reevaluate(lights);
    const std::vector<Fixture>& before = room.found->lights().fixtures;
    const std::vector<Fixture>& after = reevaluated.lights().fixtures;
    size_t changed = 0; // of the group that the brighter one belongs to
    float area = 0.0f;
    float wanted = 0.0f; // power
    for (size_t i = 0; i < after.size(); ++i) {
        if (after[i].radiance == before[i].radiance) continue;
        ++changed;
        area += after[i].area;
        wanted += lights.fixtures[i].power().g;
        EXPECT_EQ(after[i].radiance, after[0].radiance);
    }
    EXPECT_GT(changed, 1u);
    EXPECT_LT(changed, after.size());
    EXPECT_NEAR(kPi * area * after[0].radiance.g / wanted, 1.0f, 1e-4f);
}

TEST(Delighter, RefusesWhatAreNotItsLightsAndGoesOn)
{
    Room room(scenes::LitRoom().scan);
    const Lights& found = room.found->lights();
    Lights lights;
    EXPECT_EQ(codeOf([&] { static_cast<void>(room.reevaluate(lights)); }), ErrorCode::sizeMismatch);
    lights = found;
    lights.sun.emplace();
    EXPECT_EQ(codeOf([&] { static_cast<void>(room.reevaluate(lights)); }), ErrorCode::sizeMismatch);
    for (const float wrong :
         {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        lights = found;
        lights.fixtures[0].radiance.g = wrong;
        EXPECT_EQ(codeOf([&] { static_cast<void>(room.reevaluate(lights)); }),
                  ErrorCode::malformed);
    }
    Progress cancelled;
    cancelled.cancel();
    EXPECT_EQ(codeOf([&] {
                  static_cast<void>(
                      room.delighter.reevaluate(brighter(found, 2.0f), {}, cancelled));
              }),
              ErrorCode::cancelled);
    EXPECT_EQ(codeOf([&] { static_cast<void>(room.delighter.solve(thesisSolver(), cancelled)); }),
              ErrorCode::cancelled);
    Delighter fresh(scenes::copyOf(room.scan));
    EXPECT_EQ(codeOf([&] { static_cast<void>(fresh.reevaluate(found, {}, room.progress)); }),
              ErrorCode::unsupported);
}

class GpuDelighter : public scenes::GpuTest
{};

/// What two engines made of one room, as near as Delighter::reevaluate() says.
void expectAlike(const Decomposition& found, const Decomposition& expected)
{
    EXPECT_EQ(lightsAsJson(found.lights()), lightsAsJson(expected.lights()));
    EXPECT_NEAR(found.closure().rmsError, expected.closure().rmsError,
                0.01f * expected.closure().rmsError + 1e-4f);
    scenes::expectAlike(layersOf(found), layersOf(expected));
}

// What a person sees of a lamp, found or changed, must not depend on what computed it.
TEST_F(GpuDelighter, SolvesAndReevaluatesAsTheCpuDoes)
{
    for (Scan scan : {scenes::LitRoom().scan, scenes::SunRoom(glm::vec3(3.0f)).scan}) {
        DelightOptions options = draft();
        Progress progress;
        Delighter cpu(scenes::copyOf(scan));
        options.engine.engine = Engine::cpu;
        const Decomposition found = cpu.solve(options, progress);
        Delighter gpu(scenes::copyOf(scan));
        options.engine.engine = Engine::gpu;
        const Decomposition foundByGpu = gpu.solve(options, progress);
        EXPECT_EQ(foundByGpu.optionsInForce().engine.gpu, device().description().name);
        EXPECT_EQ(found.optionsInForce().engine.gpu, "cpu");
        EXPECT_EQ(foundByGpu.warnings(), found.warnings());
        expectAlike(foundByGpu, found);
        for (const float factor : {1.5f, 0.4f, 0.0f}) {
            Lights lights = brighter(found.lights(), factor);
            if (lights.sun) lights.sun->irradiance *= factor;
            lights.ambient += glm::vec3(0.05f);
            const Decomposition expected = cpu.reevaluate(lights, options.albedo, progress);
            const Decomposition reevaluated = gpu.reevaluate(lights, options.albedo, progress);
            EXPECT_EQ(reevaluated.optionsInForce().engine.gpu, device().description().name);
            expectAlike(reevaluated, expected);
        }
        // And back, to the bit.
        expectSame(gpu.reevaluate(found.lights(), options.albedo, progress), foundByGpu);
        expectSame(delight(scenes::copyOf(scan), options, progress), foundByGpu);
    }
}

TEST_F(GpuDelighter, SaysAtOnceThatADeviceIsNotThere)
{
    const Scan scan = scenes::LitRoom().scan;
    Progress progress;
    Delighter delighter(scenes::copyOf(scan));
    DelightOptions options = draft();
    options.engine.gpu = "no such";
    EXPECT_EQ(codeOf([&] { static_cast<void>(delighter.solve(options, progress)); }),
              ErrorCode::device);
    EXPECT_EQ(codeOf([&] { static_cast<void>(delight(scenes::copyOf(scan), options, progress)); }),
              ErrorCode::device);
    options.engine = {.engine = Engine::gpu};
    options.solver = Solver::pathtrace; // which is the CPU's
    EXPECT_EQ(codeOf([&] { static_cast<void>(delight(scenes::copyOf(scan), options, progress)); }),
              ErrorCode::unsupported);
}

// They share what lies on the device.
TEST_F(GpuDelighter, EarlierResultsStayWhatTheyAre)
{
    const Scan scan = scenes::LitRoom().scan;
    Progress progress;
    Delighter delighter(scenes::copyOf(scan));
    DelightOptions options = thesisSolver();
    options.engine.engine = Engine::gpu;
    const Decomposition first = delighter.solve(options, progress);
    const PageLayers before = layersOf(first);
    options.thesis.lpvSteps = 3;
    options.thesis.attenuation = glm::vec3(1.0f, 0.0f, 1.0f);
    const Decomposition second = delighter.solve(options, progress);
    const PageLayers after = layersOf(second);
    EXPECT_NE(after.indirect, before.indirect);
    EXPECT_EQ(layersOf(first).albedo, before.albedo);
    EXPECT_EQ(layersOf(second).albedo, after.albedo);
    EXPECT_EQ(layersOf(first).indirect, before.indirect);
    expectSame(second, delight(scenes::copyOf(scan), options, progress));
}

} // namespace relamp
