#include "solve/by_pathtrace.h"

#include "base/half.h"
#include "relamp/delight.h"
#include "relamp/threads.h"
#include "scenes/scenes.h"
#include "shading/enclosed_texels.h"
#include "solve/find_room.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kSize(4.0f, 2.5f, 5.0f);

/// Broad stripes and a colour a wall; white where the panel in the ceiling is.
glm::vec3 paper(glm::vec3 p, glm::vec3 n)
{
    if (n.y < -0.5f && std::abs(p.x - 2.0f) < 0.4f && std::abs(p.z - 2.5f) < 0.4f)
        return glm::vec3(1.0f);
    const float stripe = std::fmod(p.x + p.y + p.z, 1.0f) < 0.5f ? 1.0f : 0.6f;
    return stripe * (glm::vec3(0.5f) + 0.2f * n);
}

/// The room of this paper as a camera sees it once its panel shines and light has bounced about.
struct PaperRoom
{
    explicit PaperRoom(glm::vec3 radiance)
        : scan(scenes::room(kSize, 40, paper)), scene(scan),
          texels(rasterizeAtlas(scan, progress, surfelsOf(GatherOptions{})))
    {
        separateEnclosed(texels, scene, progress);
        const TracedRoom room = roomWith(radiance);
        const PathTracer tracer(texels, scene, room);
        const PageTexels& page = texels.pages[0];
        std::vector<uint16_t>& half = scan.pages[0].image.half();
        forEachChunk(page.count(), 64, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                if (room.isClipped[0][page.pixel[i]]) continue;
                const glm::vec3 shading =
                    tracer.shade(texels.siteOf(0, i), 128, Random(7, 7, i)).total();
                for (int c = 0; c < 3; ++c) {
                    uint16_t& value = half[3 * size_t{page.pixel[i]} + static_cast<size_t>(c)];
                    value = halfFromFloat(std::min(shading[c] * floatFromHalf(value), 1.0f));
                }
            }
        });
    }

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;

private:
    [[nodiscard]] TracedRoom roomWith(glm::vec3 radiance)
    {
        FoundRoom found;
        found.radiance = collectRadiance(texels, progress);
        found.found.lamps.push_back({.patches = found.radiance.clipped});
        found.found.powers.lamps = {radiance};
        return tracedRoomOf(texels, found, found.radiance.plain); // as yet the texture is the paper
    }
};

constexpr glm::vec3 kPanel(12.0f, 10.0f, 8.0f);

/// Mean over texels that are not burnt out.
struct Means
{
    double direct = 0.0;
    double indirect = 0.0;
    double albedoError = 0.0; // rms of log(albedo / paper), green
};

/// Over what `trusted` is sure of.
Means meansOf(const PaperRoom& lit, const PageLayers& layers, const PageLayers& trusted)
{
    Means means;
    double count = 0.0;
    const PageTexels& page = lit.texels.pages[0];
    for (size_t i = 0; i < page.count(); ++i) {
        const size_t green = 3 * size_t{page.pixel[i]} + 1;
        if (trusted.confidence[page.pixel[i]] < 128) continue;
        const TexelSite site = lit.texels.siteOf(0, i);
        const float albedo = floatFromHalf(layers.albedo[green]);
        const double error = std::log(albedo / paper(site.position, site.normal).g);
        means.direct += static_cast<double>(floatFromHalf(layers.direct[green]));
        means.indirect += static_cast<double>(floatFromHalf(layers.indirect[green]));
        means.albedoError += error * error;
        count += 1.0;
    }
    means.direct /= count;
    means.indirect /= count;
    means.albedoError = std::sqrt(means.albedoError / count);
    return means;
}

} // namespace

// A room shaded by path tracing gives its albedo back to both solvers that see shadows, and they
// say the same of the light in it.
TEST(ByPathtrace, AgreesWithTheGatherSolverAndWithThePaper)
{
    PaperRoom lit(kPanel);
    const Decomposition gather = delight(scenes::copyOf(lit.scan), {}, lit.progress);
    ASSERT_EQ(gather.lights().fixtures.size(), 1u);
    const Decomposition traced =
        delight(scenes::copyOf(lit.scan),
                {.solver = Solver::pathtrace, .pathtrace = {.samples = 64}}, lit.progress);
    const PageLayers ofGather = gather.layers(0, lit.progress);
    const Means a = meansOf(lit, ofGather, ofGather);
    const Means b = meansOf(lit, traced.layers(0, lit.progress), ofGather);
    // The lamp comes out 4 % too weak; the correction of the light makes up for that, and paths do
    // not know of it.
    EXPECT_NEAR(b.direct, a.direct, 0.05 * a.direct);
    EXPECT_NEAR(b.indirect, a.indirect, 0.05 * a.indirect);
    EXPECT_LT(a.albedoError, 0.09);
    EXPECT_LT(b.albedoError, 0.09); // most of it the noise of 64 paths
    EXPECT_LT(traced.closure().rmsError, 0.05f * traced.closure().rmsInput);
}

TEST(ByPathtrace, FollowsItsSeedAndNotItsThreads)
{
    PaperRoom lit(kPanel);
    const auto run = [&](int threads, uint32_t seed) {
        const ThreadLimit limit(threads);
        const DelightOptions options{.solver = Solver::pathtrace,
                                     .pathtrace = {.samples = 4, .seed = seed}};
        return delight(scenes::copyOf(lit.scan), options, lit.progress)
            .layers(0, lit.progress)
            .albedo;
    };
    const auto one = run(1, 5);
    EXPECT_EQ(one, run(8, 5));
    EXPECT_NE(one, run(8, 6));
}

} // namespace relamp
