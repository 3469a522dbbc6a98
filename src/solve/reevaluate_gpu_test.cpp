#include "solve/reevaluate_gpu.h"

#include "base/radiometry.shared.h"
#include "scenes/apart_layers.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/scenes.h"
#include "scenes/solved.h"
#include "scenes/sun_room.h"
#include "solve/room_solution.h"

#include <map>
#include <memory>
#include <string>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;
using ::testing::ElementsAre;

/// The lit room, and a table top in it that has a page of its own.
Scan roomOfTwoPages()
{
    Scan scan = scenes::LitRoom().scan;
    Scan top = scenes::square(1.2f, 64, scenes::plain(glm::vec3(0.6f, 0.5f, 0.4f)));
    for (glm::vec3& position : top.meshes[0].positions) position += glm::vec3(1.0f, 0.8f, 1.5f);
    top.meshes[0].page = 1;
    scan.meshes.push_back(top.meshes[0]);
    scan.pages.push_back(top.pages[0]);
    return scan;
}

/// Open above, so that it is lit from outside.
Scan roomWithoutLamps()
{
    std::vector<scenes::Panel> walls = scenes::wallsOf({4.0f, 2.5f, 5.0f});
    walls.erase(walls.begin() + 2); // a side: in a ceiling that is missing lamps are sought
    return scenes::panels(walls, 96, [](glm::vec3 p, glm::vec3 n) {
        return glm::vec3(0.4f, 0.3f, 0.2f) + 0.1f * n + 0.02f * p;
    });
}

/// Other powers than those that were found.
LampPowers others(LampPowers powers)
{
    for (size_t l = 0; l < powers.lamps.size(); ++l)
        powers.lamps[l] *= glm::vec3(1.7f, 1.5f, 1.2f - 0.3f * static_cast<float>(l % 2));
    powers.outside = powers.outside[0] + glm::vec3(0.02f, 0.03f, 0.05f);
    return powers;
}

/// A room that both engines have solved again under other powers.
struct ReevaluateTwins
{
    ReevaluateTwins(const gpu::Device& device, Scan scan)
        : room(std::move(scan)), found(room.solved.found.found.powers), powers(others(found)),
          gpu(device, room.texels, room.solved)
    {
        gather(found); // that it has to change
        reevaluate(room.texels, room.solved, powers);
        said = solutionOf(room.texels, room.solved, {}, closureOf(room.solved)).texels;
        gather(powers);
        gpu.setSurfels(said);
    }

    std::vector<gpu::Timing> gather(const LampPowers& under)
    {
        return gpu.gather(under, room.solved.found.sides.field.shines);
    }

    [[nodiscard]] size_t pages() const { return room.texels.pages.size(); }

    /// Calls `visit(block, shading, begin)` for the texels of a page, shaded by the CPU.
    template<class Visit>
    void forEachShaded(size_t page, const Visit& visit) const
    {
        const TexelShading shade = shadingOf(room.texels, room.solved);
        const TexelLoader loader(room.texels, page);
        TexelBlock block;
        ShadingBlock shading;
        const size_t count = room.texels.pages[page].count();
        for (size_t begin = 0; begin < count; begin += TexelBlock::kCapacity) {
            const size_t size = std::min(TexelBlock::kCapacity, count - begin);
            loader.load(begin, size, block);
            loader.loadSurfel(begin, size, block);
            shade(page, begin, block, shading);
            visit(block, shading, begin);
        }
    }

    scenes::Solved room;
    LampPowers found;
    LampPowers powers;
    ReevaluateGpu gpu;
    SolvedTexels said; // under `powers`, by the CPU
};

/// Every test runs on each of these; they are made once.
class GpuReevaluate : public scenes::GpuTest, public testing::WithParamInterface<const char*>
{
protected:
    static void TearDownTestSuite()
    {
        rooms_.clear();
        scenes::GpuTest::TearDownTestSuite();
    }

    static ReevaluateTwins& twins()
    {
        const std::string name = GetParam();
        std::unique_ptr<ReevaluateTwins>& room = rooms_[name];
        if (room) return *room;
        Progress progress;
        if (name == "TwoPages")
            room = std::make_unique<ReevaluateTwins>(device(), roomOfTwoPages());
        else if (name == "Sun")
            room =
                std::make_unique<ReevaluateTwins>(device(), scenes::SunRoom(glm::vec3(3.0f)).scan);
        else if (name == "NoLamp")
            room = std::make_unique<ReevaluateTwins>(device(), roomWithoutLamps());
        else
            room = std::make_unique<ReevaluateTwins>(
                device(), readScan(RELAMP_SAMPLES "/bedroom/scan.glb", {}, progress));
        return *room;
    }

private:
    static std::map<std::string, std::unique_ptr<ReevaluateTwins>> rooms_;
};

std::map<std::string, std::unique_ptr<ReevaluateTwins>> GpuReevaluate::rooms_;

INSTANTIATE_TEST_SUITE_P(Rooms, GpuReevaluate,
                         testing::Values("TwoPages", "Sun", "NoLamp", "Sample"),
                         [](const auto& room) { return std::string(room.param); });

} // namespace

// The whole of the light on surfels, from powers: sums of lamps, four rounds, smoothing.
TEST_P(GpuReevaluate, LightsSurfelsAsTheCpuDoes)
{
    const ReevaluateTwins& room = twins();
    ASSERT_EQ(room.powers.lamps.empty(), GetParam() == std::string("NoLamp"));
    ASSERT_EQ(room.room.solved.found.found.sun.has_value(), GetParam() == std::string("Sun"));
    const std::vector<glm::vec4> found = room.gpu.indirectOnSurfels();
    Apart indirect(0.02f);
    Apart lit(0.02f);
    for (size_t s = 0; s < found.size(); ++s) {
        indirect.add(glm::vec3(found[s]), room.room.solved.light->indirect[s]);
        lit.add(glm::vec3(found[s].w), glm::vec3(room.room.solved.lit[s]));
    }
    EXPECT_LT(indirect.beyond(2e-3f), 1e-3);
    EXPECT_LT(indirect.most(), 0.01f);
    EXPECT_LT(lit.most(), 1e-6f);
}

TEST_P(GpuReevaluate, ShadesTexelsAsTheCpuDoes)
{
    ReevaluateTwins& room = twins();
    for (size_t p = 0; p < room.pages(); ++p) {
        room.gpu.shade(p);
        const PageIrradiance irradiance = room.gpu.irradiance();
        Apart apartDirect(0.02f);
        Apart apartIndirect(0.02f);
        room.forEachShaded(p, [&](const TexelBlock& block, const ShadingBlock& shading, size_t b) {
            for (size_t i = 0; i < block.count; ++i) {
                apartDirect.add(glm::vec3(halves(irradiance.direct[b + i])) / kPi,
                                scenes::at(shading.direct, i));
                apartIndirect.add(glm::vec3(halves(irradiance.indirect[b + i])) / kPi,
                                  scenes::at(shading.indirect, i));
            }
        });
        EXPECT_LT(apartDirect.beyond(3e-3f), 1e-3);
        EXPECT_LT(apartDirect.most(), 0.02f);
        EXPECT_LT(apartIndirect.beyond(3e-3f), 1e-3);
        EXPECT_LT(apartIndirect.most(), 0.02f);
    }
}

// The whole chain, from powers to finished pages: rims, what is burnt out, doubts and padding too.
TEST_P(GpuReevaluate, EndsInTheLayersOfTheCpu)
{
    ReevaluateTwins& room = twins();
    for (size_t p = 0; p < room.pages(); ++p)
        for (const bool fill : {false, true}) {
            Progress progress;
            const AlbedoOptions options{.fill = fill};
            room.gpu.divide(p, options);
            const PageLayers found = room.gpu.layers();
            const PageLayers expected =
                makeLayers(room.room.texels, p, room.said, options, progress);
            scenes::expectAlike(found, expected);
            EXPECT_LT(scenes::apart(found.albedo, expected.albedo).most(), 0.02f);
        }
}

TEST_P(GpuReevaluate, ComputesAgainOnlyWhatChanged)
{
    ReevaluateTwins& room = twins();
    room.gather(room.powers);
    room.gpu.divide(0, {});
    const PageLayers before = room.gpu.layers();
    EXPECT_THAT(scenes::ran(room.gather(room.powers)), ElementsAre());
    EXPECT_THAT(scenes::ran(room.gpu.divide(0, {})), ElementsAre());
    EXPECT_THAT(scenes::ran(room.gpu.divide(0, {.darkest = 0.1f})),
                ElementsAre("divide", "padding"));

    EXPECT_THAT(scenes::ran(room.gather(room.found)), ElementsAre("gather"));
    EXPECT_THAT(scenes::ran(room.gpu.divide(0, {})), ElementsAre("shading", "divide", "padding"));
    EXPECT_NE(room.gpu.layers().albedo, before.albedo);

    // And back again, to the same bits.
    room.gather(room.powers);
    room.gpu.divide(0, {});
    EXPECT_EQ(room.gpu.layers().albedo, before.albedo);
    EXPECT_EQ(room.gpu.layers().confidence, before.confidence);
}

using GpuReevaluatePages = scenes::GpuTest;

TEST_F(GpuReevaluatePages, TakeTurnsWhereMemoryIsShort)
{
    ReevaluateTwins room(device(), roomOfTwoPages());
    ReevaluateGpu oneAtATime(device(), room.room.texels, room.room.solved, 1);
    oneAtATime.gather(room.powers, room.room.solved.found.sides.field.shines);
    oneAtATime.setSurfels(room.said);
    for (const size_t p : {0u, 1u, 0u}) {
        room.gpu.divide(p, {});
        EXPECT_THAT(scenes::ran(oneAtATime.divide(p, {})),
                    ElementsAre("lamps", "shading", "divide", "padding"));
        EXPECT_EQ(oneAtATime.irradiance().direct, room.gpu.irradiance().direct);
        EXPECT_EQ(oneAtATime.irradiance().indirect, room.gpu.irradiance().indirect);
        EXPECT_EQ(oneAtATime.layers().albedo, room.gpu.layers().albedo);
    }
}

} // namespace relamp
