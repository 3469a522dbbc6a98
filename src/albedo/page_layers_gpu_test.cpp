#include "albedo/page_layers_gpu.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "scenes/apart_layers.h"
#include "scenes/gpu_scene.h"
#include "scenes/scenes.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Numbers that look drawn, 0..1.
float drawn(size_t i, uint32_t salt)
{
    auto h = static_cast<uint32_t>(i) * 0x9e3779b9u + salt * 0x85ebca6bu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return static_cast<float>((h ^ h >> 16) >> 8) / 16777216.0f;
}

glm::vec3 drawnColor(size_t i, uint32_t salt)
{
    return {drawn(i, salt), drawn(i, salt + 1), drawn(i, salt + 2)};
}

/// Walls from black to burnt out, in one channel or in all.
Scan motleyRoom()
{
    return scenes::panels(scenes::wallsOf({4.0f, 2.5f, 5.0f}), 64, [](glm::vec3 p, glm::vec3 n) {
        const auto place = static_cast<size_t>(1000.0f * (p.x + 7.0f * p.y + 31.0f * p.z + n.x));
        return glm::min(1.3f * drawnColor(place, 1), glm::vec3(1.0f));
    });
}

/// A page, light on it that was drawn, and what is said of its surfels.
struct Lit
{
    explicit Lit(Scan of) : scan(std::move(of)), texels(rasterizeAtlas(scan, progress))
    {
        for (size_t i = 0; i < texels.pages[0].count(); ++i) {
            direct.push_back(packedHalves(glm::vec4(2.0f * kPi * drawnColor(i, 11), 0.0f)));
            indirect.push_back(packedHalves(glm::vec4(0.1f * kPi * drawnColor(i, 21), 0.0f)));
        }
        said.shade = [this](size_t, size_t begin, const TexelBlock& block, ShadingBlock& out) {
            set(direct, begin, block.count, out.direct);
            set(indirect, begin, block.count, out.indirect);
        };
        said.shining.surfels.assign(texels.surfels.count(), 0);
    }
    Lit(const Lit&) = delete;
    Lit& operator=(const Lit&) = delete;

    /// Something of everything, of some surfels.
    void sayAll()
    {
        said.tempering = {{0.9f, 1.0f, 1.1f}, 0.6f, {0.8f, 0.9f, 1.2f}};
        for (size_t s = 0; s < texels.surfels.count(); ++s) {
            said.shining.surfels[s] = drawn(s, 31) < 0.2f ? 1 : 0;
            said.shining.glowsFrom.push_back(drawn(s, 32) < 0.5f ? 0.5f : 1e30f);
            said.rims.push_back({3.0f * drawnColor(s, 41), drawn(s, 44) < 0.5f ? 0.4f : 0.0f});
            said.trust.push_back(
                {drawn(s, 51), 1.0f, 0.5f + 0.5f * drawn(s, 52), 0.5f + 0.5f * drawn(s, 53)});
            said.fill.push_back(0.9f * drawnColor(s, 61));
            said.doubt.push_back(drawn(s, 71) < 0.3f ? 0.0f : drawn(s, 72));
        }
    }

    static void set(const std::vector<glm::uvec2>& irradiance, size_t begin, size_t count,
                    RgbBlock& out)
    {
        for (size_t i = 0; i < count; ++i) {
            const glm::vec4 e = halves(irradiance[begin + i]) / kPi;
            out.r[i] = e.r;
            out.g[i] = e.g;
            out.b[i] = e.b;
        }
    }

    [[nodiscard]] PageLayers byCpu(const AlbedoOptions& options)
    {
        return makeLayers(texels, 0, said, options, progress);
    }
    [[nodiscard]] PageLayers byGpu(const gpu::Device& device, const AlbedoOptions& options) const
    {
        const Image& image = scan.pages[0].image;
        const LayerPictures pictures(device, static_cast<uint32_t>(image.width),
                                     static_cast<uint32_t>(image.height));
        divide(device, options, pictures);
        return layersFrom(pictures, texels, 0, said.linearization);
    }
    void divide(const gpu::Device& device, const AlbedoOptions& options,
                const LayerPictures& pictures) const
    {
        const GpuTexels page(device, texels, 0, said.linearization);
        const gpu::Array<glm::uvec2> directThere(device, direct);
        const gpu::Array<glm::uvec2> indirectThere(device, indirect);
        PageLayersGpu gpu(device, texels.surfels.count());
        const PaddingGpu padding(device);
        gpu.setSurfels(said);
        gpu::Commands commands(device);
        pictures.clear(commands);
        const Image& image = scan.pages[0].image;
        gpu.divide(commands, {page, directThere, indirectThere, image}, options, pictures);
        padding.fill(commands, {pictures.albedo, pictures.direct, pictures.indirect});
        commands.run();
    }

    Progress progress;
    Scan scan;
    Texels texels;
    std::vector<glm::uvec2> direct; // irradiance of texels, halves
    std::vector<glm::uvec2> indirect;
    SolvedTexels said;
};

} // namespace

using GpuPageLayers = scenes::GpuTest;

TEST_F(GpuPageLayers, AreThoseOfTheCpu)
{
    Lit lit(motleyRoom());
    for (const bool isAllSaid : {false, true}) {
        if (isAllSaid) lit.sayAll();
        for (const bool fill : {false, true}) {
            const AlbedoOptions options{.darkest = 0.1f, .fill = fill};
            const PageLayers expected = lit.byCpu(options);
            EXPECT_EQ(expected.emission.empty(), !isAllSaid);
            scenes::expectAlike(lit.byGpu(device(), options), expected);
        }
    }
}

// Each says something else of the same texels; all of them together are tested above.
TEST_F(GpuPageLayers, FollowWhatIsSaidOfSurfels)
{
    Lit lit(motleyRoom());
    const PageLayers plain = lit.byGpu(device(), {});
    Lit all(motleyRoom());
    all.sayAll();
    const std::vector<std::function<void(SolvedTexels&)>> parts = {
        [&](SolvedTexels& said) { said.rims = all.said.rims; },
        [&](SolvedTexels& said) { said.tempering = all.said.tempering; },
        [&](SolvedTexels& said) { said.shining = all.said.shining; },
        [&](SolvedTexels& said) { said.trust = all.said.trust; },
        [&](SolvedTexels& said) {
            said.fill = all.said.fill;
            for (size_t s = 0; s < said.fill.size(); ++s) // halves hold a power of two exactly
                said.linearization.perGain.push_back(
                    glm::exp2(glm::round(2.0f * drawnColor(s, 71) - 1.0f)));
        },
        [&](SolvedTexels& said) { said.fill = all.said.fill; }};
    const SolvedTexels nothing = lit.said;
    for (const auto& say : parts) {
        lit.said = nothing;
        say(lit.said);
        const PageLayers found = lit.byGpu(device(), {});
        EXPECT_TRUE(found.albedo != plain.albedo || found.confidence != plain.confidence);
        scenes::expectAlike(found, lit.byCpu({}));
    }
}

TEST_F(GpuPageLayers, TakeThePicturesOfAnotherPage)
{
    Lit lit(motleyRoom());
    lit.sayAll();
    const int width = lit.scan.pages[0].image.width;
    const int height = lit.scan.pages[0].image.height;
    const LayerPictures pictures(device(), static_cast<uint32_t>(width),
                                 static_cast<uint32_t>(height));
    const int side = std::min(width, height);
    Lit(scenes::square(1.0f, side, scenes::plain(glm::vec3(0.7f)))).divide(device(), {}, pictures);
    lit.divide(device(), {}, pictures);
    scenes::expectAlike(layersFrom(pictures, lit.texels, 0, lit.said.linearization), lit.byCpu({}));
}

TEST_F(GpuPageLayers, RateTexelsOfSeveralPlacesAsTheCpuDoes)
{
    Scan scan = motleyRoom();
    scan.meshes.push_back(scan.meshes[0]);
    scan.meshes[1].triangles.resize(2); // a wall once more, in the middle of the room
    scan.meshes[1].normals.resize(6);
    for (glm::vec3& p : scan.meshes[1].positions) p += glm::vec3(1.0f);
    Lit lit(std::move(scan));
    lit.sayAll();
    const PageLayers found = lit.byGpu(device(), {});
    EXPECT_GT(found.area[static_cast<size_t>(Doubt::shared)], 1.0);
    scenes::expectAlike(found, lit.byCpu({}));
}

// White is no end of a texture of floats.
TEST_F(GpuPageLayers, NothingIsBurntOutWhereWhiteIsNoEnd)
{
    Scan scan = motleyRoom();
    scan.pages[0].image.clipsAtWhite = false;
    Lit lit(std::move(scan));
    lit.sayAll();
    lit.said.shining.threshold = 0.5f;
    const PageLayers found = lit.byGpu(device(), {});
    EXPECT_EQ(found.area[static_cast<size_t>(Doubt::clipped)], 0.0);
    EXPECT_GT(found.area[static_cast<size_t>(Doubt::shines)], 0.0);
    scenes::expectAlike(found, lit.byCpu({}));
}

} // namespace relamp
