#include "thesis/thesis_gpu.h"

#include "albedo/divide.h"
#include "albedo/divide.shared.h"
#include "base/half.h"
#include "image/padding.h"
#include "scan/rays.h"
#include "scenes/apart.h"
#include "scenes/gpu_scene.h"
#include "scenes/scenes.h"
#include "thesis/emitters.h"
#include "thesis/fixtures.h"
#include "thesis/thesis_shading.h"
#include "thesis/thesis_shading.shared.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;
using ::testing::ElementsAre;

glm::vec3 rgbOf(glm::uvec2 packed)
{
    const auto half = [](uint32_t bits) { return floatFromHalf(static_cast<uint16_t>(bits)); };
    return {half(packed.x & 0xffffu), half(packed.x >> 16), half(packed.y & 0xffffu)};
}

bool isCovered(glm::uvec2 packed)
{
    return packed.y >> 16 != 0;
}

glm::vec3 stripes(glm::vec3 p, glm::vec3 n)
{
    const float stripe = std::fmod(3.0f * (p.x + p.y + p.z), 1.0f) < 0.5f ? 1.0f : 0.5f;
    return stripe * (glm::vec3(0.4f) + 0.2f * n);
}

Lights twoLamps()
{
    Lights lights;
    lights.points.push_back(
        {.position = {1.5317f, 2.1723f, 2.0441f}, .intensity = {2.0f, 1.5f, 1.0f}});
    lights.points.push_back(
        {.position = {3.0237f, 1.0719f, 3.9053f}, .intensity = {0.1f, 0.3f, 0.5f}});
    return lights;
}

/// A box, and a table top in it that has a page of its own.
Scan stripedRoomOfTwoPages()
{
    Scan scan = scenes::room({4.0f, 2.5f, 5.0f}, 64, stripes);
    Scan top = scenes::square(1.2f, 64, stripes);
    for (glm::vec3& position : top.meshes[0].positions) position += glm::vec3(1.0f, 0.8f, 1.5f);
    top.meshes[0].page = 1;
    scan.meshes.push_back(top.meshes[0]);
    scan.pages.push_back(top.pages[0]);
    return scan;
}

/// The box again, with colours at its corners instead of a texture: a grid of vertices a wall.
Scan roomOfVertices()
{
    constexpr int kCells = 24;
    Scan scan = scenes::room({4.0f, 2.5f, 5.0f}, 8, stripes);
    Mesh& mesh = scan.meshes[0];
    mesh = {.name = "walls", .page = 0};
    Image& colors = scan.pages[0].image;
    colors.half().clear();
    scan.pages[0].ofVertices = true;
    for (const scenes::Panel& wall : scenes::wallsOf({4.0f, 2.5f, 5.0f})) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (int i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
            mesh.positions.push_back(wall.at(static_cast<float>(i % (kCells + 1)) / kCells,
                                             static_cast<float>(i / (kCells + 1)) / kCells));
            const glm::vec3 color = stripes(mesh.positions.back(), wall.normal());
            for (int c = 0; c < 3; ++c) colors.half().push_back(halfFromFloat(color[c]));
        }
        for (uint32_t y = 0; y < kCells; ++y)
            for (uint32_t x = 0; x < kCells; ++x) {
                const uint32_t at = first + y * (kCells + 1) + x;
                mesh.triangles.emplace_back(at, at + 1, at + kCells + 1);
                mesh.triangles.emplace_back(at + 1, at + kCells + 2, at + kCells + 1);
                mesh.normals.insert(mesh.normals.end(), 6, wall.normal());
            }
    }
    colors.width = static_cast<int>(mesh.positions.size());
    colors.height = 1;
    return scan;
}

/// A room that both engines have worked on.
struct ThesisTwins
{
    ThesisTwins(const gpu::Device& device, Scan theScan, std::optional<Lights> lights)
        : scan(std::move(theScan)), scene(scan), texels(rasterizeAtlas(scan, progress)),
          gpu(device, texels)
    {
        frame.lights = lights ? *lights : found();
        frame.parameters = deriveParameters({}, frame.lights, boundsOf(scan));
        frame.parameters.power = 1.7f;
        frame.ambient = {0.02f, 0.03f, 0.04f};
        cpu = solveThesis(texels, scene, frame.lights, frame.parameters, progress);
        cpu.ambient = frame.ambient;
        gpu.bounce(frame);
    }

    Lights found()
    {
        SurfelLight light = collectLight(texels, {}, progress);
        joinFixtures(light, texels, {});
        Lights lights;
        lights.points = pointLightsFrom(light.emitters, 6);
        return lights;
    }

    /// Calls `visit(block, begin)` for the texels of a page.
    template<class Visit>
    void forEachBlockOf(size_t page, const Visit& visit) const
    {
        const TexelLoader loader(texels, page);
        TexelBlock block;
        const size_t count = texels.pages[page].count();
        for (size_t begin = 0; begin < count; begin += TexelBlock::kCapacity) {
            loader.load(begin, std::min(TexelBlock::kCapacity, count - begin), block);
            visit(block, begin);
        }
    }

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;
    ThesisFrame frame;
    ThesisShading cpu;
    ThesisGpu gpu;
};

/// Every test runs on each of these; they are made once.
class GpuThesis : public scenes::GpuTest, public testing::WithParamInterface<const char*>
{
protected:
    static void TearDownTestSuite()
    {
        rooms_.clear();
        scenes::GpuTest::TearDownTestSuite();
    }

    static ThesisTwins& twins()
    {
        const std::string name = GetParam();
        std::unique_ptr<ThesisTwins>& room = rooms_[name];
        if (room) return *room;
        Progress progress;
        if (name == "TwoPages")
            room = std::make_unique<ThesisTwins>(device(), stripedRoomOfTwoPages(), twoLamps());
        else if (name == "Vertices")
            room = std::make_unique<ThesisTwins>(device(), roomOfVertices(), twoLamps());
        else
            room = std::make_unique<ThesisTwins>(
                device(), readScan(RELAMP_SAMPLES "/bedroom/scan.glb", {}, progress), std::nullopt);
        return *room;
    }

private:
    static std::map<std::string, std::unique_ptr<ThesisTwins>> rooms_;
};

std::map<std::string, std::unique_ptr<ThesisTwins>> GpuThesis::rooms_;

INSTANTIATE_TEST_SUITE_P(Rooms, GpuThesis, testing::Values("TwoPages", "Vertices", "Sample"),
                         [](const auto& room) { return std::string(room.param); });

} // namespace

// A texel at the edge between two bins of brightness may fall into the other, as radiance is
// halves.
TEST_P(GpuThesis, FlattensAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    Progress progress;
    const Flattened expected =
        flatten(room.texels,
                {room.frame.parameters.flattenReach, room.frame.parameters.flattenRange}, progress);
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        room.gpu.page(room.frame, p);
        const std::vector<uint32_t> found = room.gpu.flattened();
        Apart steps(255.0f); // of a byte
        for (const uint32_t pixel : room.texels.pages[p].pixel) {
            const uint8_t* bytes = &expected.pages[p][3 * size_t{pixel}];
            steps.add({found[pixel] & 255u, found[pixel] >> 8 & 255u, found[pixel] >> 16 & 255u},
                      {bytes[0], bytes[1], bytes[2]});
        }
        EXPECT_LT(steps.beyond(1.5f / 255.0f), 1e-3);
        EXPECT_LE(steps.most(), 12.0f / 255.0f);
    }
}

TEST_P(GpuThesis, LightsDirectlyAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        room.gpu.page(room.frame, p);
        const std::vector<glm::uvec2> found = room.gpu.direct();
        Apart apart(0.05f);
        room.forEachBlockOf(p, [&](const TexelBlock& block, size_t begin) {
            RgbBlock expected;
            directIrradiance(block, room.cpu.lights, *room.frame.parameters.attenuation, expected);
            for (size_t i = 0; i < block.count; ++i)
                apart.add(rgbOf(found[begin + i]), scenes::at(expected, i));
        });
        EXPECT_LT(apart.most(), 2e-3f);
    }
}

// Rays that run along an edge may meet the one side or the other.
TEST_P(GpuThesis, SeesFromItsLightsWhatTheCpuSees)
{
    ThesisTwins& room = twins();
    const std::vector<BounceLight> expected = reflectiveShadowMaps(
        room.texels, room.scene, lightsOfShadowMaps(room.frame.lights, room.frame.parameters),
        room.frame.parameters.rsmSize);
    std::map<std::pair<uint32_t, uint32_t>, glm::vec3> fluxOf; // by page and pixel
    glm::vec3 all(0.0f);
    for (const BounceLight& light : expected) {
        fluxOf[{light.page, light.pixel}] += light.flux;
        all += light.flux;
    }
    size_t count = 0;
    for (const RsmPixel& pixel : room.gpu.maps().pixels().download()) {
        if (pixel.page == ~0u) continue;
        ++count;
        fluxOf[{pixel.page, pixel.pixel}] -= pixel.flux;
    }
    glm::vec3 elsewhere(0.0f);
    for (const auto& [where, flux] : fluxOf) elsewhere += glm::abs(flux);
    EXPECT_NEAR(static_cast<double>(count), static_cast<double>(expected.size()),
                2e-4 * static_cast<double>(expected.size()));
    for (int c = 0; c < 3; ++c) EXPECT_LT(elsewhere[c], 0.01f * all[c]);
}

// From the same bounce light.
TEST_P(GpuThesis, SpreadsLightAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    std::vector<BounceLight> lights;
    const std::vector<RsmPixel> pixels = room.gpu.maps().pixels().download();
    const std::vector<glm::vec4> leaving = room.gpu.maps().leaving().download();
    for (size_t i = 0; i < pixels.size(); ++i)
        if (pixels[i].page != ~0u)
            lights.push_back({pixels[i].position, pixels[i].normal, glm::vec3(leaving[i])});
    const std::shared_ptr<const Lpv> cpu = spread(room.texels, lights, room.frame.parameters);
    const Lpv::Field& expected = cpu->accumulated();
    const std::shared_ptr<const Lpv> found = room.gpu.volume();
    for (size_t c = 0; c < 3; ++c) {
        const float most = *std::max_element(expected[c][0].begin(), expected[c][0].end());
        float apart = 0.0f;
        for (size_t k = 0; k < 4; ++k)
            for (size_t i = 0; i < expected[c][k].size(); ++i)
                apart =
                    std::max(apart, std::abs(found->accumulated()[c][k][i] - expected[c][k][i]));
        EXPECT_LT(apart, 1e-4f * most);
    }
}

// Of the same volume, so that only the look-up is compared. Samplers have eight bits of where
// between two cells a place lies: an H200 is off by 0.0024, lavapipe by less than 0.002.
TEST_P(GpuThesis, ReadsTheVolumeOutAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    const std::shared_ptr<const Lpv> volume = room.gpu.volume();
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        room.gpu.page(room.frame, p);
        const std::vector<glm::uvec2> found = room.gpu.indirect();
        Apart apart(0.05f);
        room.forEachBlockOf(p, [&](const TexelBlock& block, size_t begin) {
            RgbBlock expected;
            volume->irradiance(block, expected);
            for (size_t i = 0; i < block.count; ++i)
                apart.add(rgbOf(found[begin + i]), scenes::at(expected, i));
        });
        EXPECT_LT(apart.most(), 4e-3f);
    }
}

// Of the same irradiance, so that only the division is compared.
TEST_P(GpuThesis, DividesAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    const float power = *room.frame.parameters.power;
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        room.gpu.page(room.frame, p);
        const std::vector<glm::uvec2> found = room.gpu.albedo();
        const std::vector<glm::uvec2> direct = room.gpu.direct();
        const std::vector<glm::uvec2> indirect = room.gpu.indirect();
        Apart apart(0.05f);
        room.forEachBlockOf(p, [&](const TexelBlock& block, size_t begin) {
            for (size_t i = 0; i < block.count; ++i) {
                const glm::vec3 shading =
                    shadingFrom(rgbOf(direct[begin + i]), power, glm::vec3(0.0f)) +
                    shadingFrom(rgbOf(indirect[begin + i]), power, room.frame.ambient);
                const glm::vec3 rho = dividedByShading({block.r[i], block.g[i], block.b[i]},
                                                       shading, room.frame.darkest);
                apart.add(rgbOf(found[room.texels.pages[p].pixel[begin + i]]),
                          rho / lightThatLacks(rho));
            }
        });
        EXPECT_LT(apart.most(), 2e-3f);
    }
}

// The whole chain, from texture to albedo. The volume hangs on single rays: one that falls on the
// other side of a stripe takes its cell's light along.
TEST_P(GpuThesis, EndsInTheAlbedoOfTheCpu)
{
    ThesisTwins& room = twins();
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        room.gpu.page(room.frame, p);
        const std::vector<glm::uvec2> found = room.gpu.albedo();
        Apart apart(0.05f);
        room.forEachBlockOf(p, [&](const TexelBlock& block, size_t begin) {
            ShadingBlock shading;
            AlbedoBlock expected;
            shade(room.cpu, block, shading);
            divide(block, shading, room.frame.darkest, expected);
            for (size_t i = 0; i < block.count; ++i)
                apart.add(rgbOf(found[room.texels.pages[p].pixel[begin + i]]),
                          {floatFromHalf(expected.r[i]), floatFromHalf(expected.g[i]),
                           floatFromHalf(expected.b[i])});
        });
        EXPECT_LT(apart.beyond(0.01f), 1e-3);
    }
}

TEST_P(GpuThesis, FillsPaddingAsTheCpuDoes)
{
    ThesisTwins& room = twins();
    room.gpu.page(room.frame, 0);
    const std::vector<glm::uvec2> found = room.gpu.albedo();
    const Image& image = room.scan.pages[0].image;
    if (room.scan.pages[0].ofVertices) return; // its pixels have no neighbours
    std::vector<uint16_t> expected(3 * found.size());
    std::vector<uint8_t> covered(found.size());
    for (size_t i = 0; i < found.size(); ++i) {
        covered[i] = isCovered(found[i]) ? 1 : 0;
        for (int c = 0; covered[i] != 0 && c < 3; ++c)
            expected[3 * i + static_cast<size_t>(c)] = halfFromFloat(rgbOf(found[i])[c]);
    }
    fillPadding(std::span(expected), covered, image.width, image.height);
    Apart apart(0.01f);
    for (size_t i = 0; i < found.size(); ++i)
        apart.add(rgbOf(found[i]),
                  {floatFromHalf(expected[3 * i]), floatFromHalf(expected[3 * i + 1]),
                   floatFromHalf(expected[3 * i + 2])});
    EXPECT_LT(apart.most(), 5e-3f);
}

TEST_P(GpuThesis, ComputesAgainOnlyWhatAParameterIsFor)
{
    ThesisTwins& room = twins();
    room.gpu.bounce(room.frame);
    room.gpu.page(room.frame, 0);
    const std::vector<glm::uvec2> before = room.gpu.albedo();
    EXPECT_THAT(scenes::ran(room.gpu.bounce(room.frame)), ElementsAre());
    EXPECT_THAT(scenes::ran(room.gpu.page(room.frame, 0)), ElementsAre());

    ThesisFrame frame = room.frame;
    frame.parameters.power = 2.0f;
    EXPECT_THAT(scenes::ran(room.gpu.bounce(frame)), ElementsAre());
    EXPECT_EQ(scenes::ran(room.gpu.page(frame, 0))[0], "divide");
    frame.parameters.lpvSteps = 3;
    EXPECT_THAT(scenes::ran(room.gpu.bounce(frame)), ElementsAre("LPV"));
    EXPECT_EQ(scenes::ran(room.gpu.page(frame, 0))[0], "LPV");
    frame.parameters.attenuation = glm::vec3(0.1f, 0.1f, 1.0f);
    EXPECT_THAT(scenes::ran(room.gpu.bounce(frame)), ElementsAre());
    EXPECT_EQ(scenes::ran(room.gpu.page(frame, 0))[0], "direct");
    frame.parameters.flattenRange = 0.1f;
    EXPECT_THAT(scenes::ran(room.gpu.bounce(frame)), ElementsAre("flatten", "RSM", "LPV"));

    // And back again, to the same bits.
    room.gpu.bounce(room.frame);
    room.gpu.page(room.frame, 0);
    EXPECT_EQ(room.gpu.albedo(), before);
}

using GpuPages = scenes::GpuTest;

TEST_F(GpuPages, TakeTurnsWhereMemoryIsShort)
{
    ThesisTwins room(device(), stripedRoomOfTwoPages(), twoLamps());
    ThesisGpu oneAtATime(device(), room.texels, 1);
    oneAtATime.bounce(room.frame);
    for (const size_t p : {0u, 1u, 0u}) {
        room.gpu.page(room.frame, p);
        oneAtATime.page(room.frame, p);
        EXPECT_EQ(oneAtATime.albedo(), room.gpu.albedo());
    }
}

} // namespace relamp
