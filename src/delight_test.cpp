#include "relamp/delight.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "decomposition_state.h"
#include "relamp/error.h"
#include "relamp/pixel_view.h"
#include "relamp/threads.h"
#include "scan/texels.h"
#include "scenes/scenes.h"
#include "thesis/direct.shared.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kRoom(4.0f, 2.5f, 5.0f);

/// Stripes and a colour a wall.
glm::vec3 paper(glm::vec3 p, glm::vec3 n)
{
    const float stripe = std::fmod(4.0f * (p.x + p.y + p.z), 1.0f) < 0.5f ? 1.0f : 0.6f;
    return stripe * (glm::vec3(0.5f) + 0.2f * n);
}

Lights oneLamp()
{
    Lights lights;
    lights.points.push_back({.position = {1.5f, 2.0f, 2.0f}, .intensity = {2.0f, 1.5f, 1.0f}});
    lights.ambient = glm::vec3(0.05f);
    return lights;
}

/// The room as a camera would see it under oneLamp(), shaded as the thesis shades.
scenes::Paint litBy(const Lights& lights)
{
    return [lights](glm::vec3 p, glm::vec3 n) {
        glm::vec3 shading(0.05f);
        for (const PointLight& light : lights.points)
            shading +=
                light.intensity * receivedFrom(light.position - p, n, {0.0f, 0.0f, 1.0f}) / kPi;
        return paper(p, n) * shading;
    };
}

DelightOptions thesis()
{
    return {.solver = Solver::thesis};
}

DelightOptions thesisOf(const Lights& lights)
{
    DelightOptions options = thesis();
    options.lights = lights;
    options.thesis.useLpv = false;
    options.thesis.attenuation = glm::vec3(0.0f, 0.0f, 1.0f);
    return options;
}

struct Worked
{
    Texels texels;
    PageLayers layers;
};

Worked work(const Scan& scan, const DelightOptions& options)
{
    Progress progress;
    const Decomposition result = delight(scenes::copyOf(scan), options, progress);
    return {rasterizeAtlas(scan, progress), result.layers(0, progress)};
}

/// Largest value of `errorOf(position, normal, albedo)` over all texels.
template<class ErrorOf>
float largestError(const Worked& worked, const ErrorOf& errorOf)
{
    float largest = 0.0f;
    const TexelLoader loader(worked.texels, 0);
    for (size_t i = 0; i < worked.texels.pages[0].count(); ++i) {
        TexelBlock block;
        loader.load(i, 1, block);
        const uint16_t* rgb = &worked.layers.albedo[3 * size_t{worked.texels.pages[0].pixel[i]}];
        const float error =
            errorOf(glm::vec3(block.x[0], block.y[0], block.z[0]),
                    glm::vec3(block.nx[0], block.ny[0], block.nz[0]),
                    glm::vec3(floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])));
        largest = std::max(largest, error);
    }
    return largest;
}

} // namespace

// What the thesis's own light model has put on, its division takes off.
TEST(Delight, RoundTripGivesThePaperBack)
{
    const Scan scan = scenes::room(kRoom, 64, litBy(oneLamp()));
    const Worked worked = work(scan, thesisOf(oneLamp()));
    const auto relativeError = [](glm::vec3 p, glm::vec3 n, glm::vec3 albedo) {
        const glm::vec3 wrong = glm::abs(albedo / paper(p, n) - 1.0f);
        return std::max({wrong.r, wrong.g, wrong.b});
    };
    EXPECT_LT(largestError(worked, relativeError),
              0.005f); // two half floats' rounding, and a third's
}

// A closed box of one radiance everywhere shows nothing but one albedo: no light can be told in it.
TEST(Delight, FurnaceIsUniform)
{
    const Scan scan = scenes::room(kRoom, 32, scenes::plain(glm::vec3(0.4f)));
    const Worked worked = work(scan, thesis());
    const auto error = [](glm::vec3, glm::vec3, glm::vec3 albedo) {
        return std::abs(albedo.g - kWhitePaint);
    };
    EXPECT_LT(largestError(worked, error), 0.01f);
}

TEST(Delight, SaysSoWhereNothingShines)
{
    const Scan scan = scenes::room(kRoom, 32, scenes::plain(glm::vec3(0.4f)));
    Progress progress;
    EXPECT_THAT(delight(scenes::copyOf(scan), thesis(), progress).warnings(),
                testing::ElementsAre(testing::HasSubstr("no light was found")));
    EXPECT_THAT(delight(scenes::copyOf(scan), {}, progress).warnings(),
                testing::ElementsAre(testing::HasSubstr("no lamp was found")));
}

/// A grey room lit from a burnt-out panel in its ceiling.
Scan panelRoom()
{
    return scenes::room(kRoom, 96, [](glm::vec3 p, glm::vec3 n) {
        if (n.y < -0.5f && std::abs(p.x - 2.0f) < 0.4f && std::abs(p.z - 2.5f) < 0.4f)
            return glm::vec3(1.0f);
        const glm::vec3 toLight = glm::vec3(2.0f, 2.5f, 2.5f) - p;
        return paper(p, n) * (0.1f + 0.6f * receivedFrom(toLight, n, {0.2f, 0.0f, 1.0f}));
    });
}

TEST(Delight, TakesMostOfAPanelsLightOff)
{
    const Scan scan = panelRoom();
    const Worked worked = work(scan, thesis());
    double before = 0.0;
    double after = 0.0;
    double count = 0.0;
    const Radiance radiance(scan.pages[0].image);
    const TexelLoader loader(worked.texels, 0);
    for (size_t i = 0; i < worked.texels.pages[0].count(); i += 7) {
        TexelBlock block;
        loader.load(i, 1, block);
        const uint32_t pixel = worked.texels.pages[0].pixel[i];
        if (radiance[pixel].g > 0.95f || block.ny[0] < -0.5f) continue;
        const float wanted =
            paper({block.x[0], block.y[0], block.z[0]}, {block.nx[0], block.ny[0], block.nz[0]}).g;
        const double logBefore = std::log(radiance[pixel].g / wanted);
        const double logAfter =
            std::log(floatFromHalf(worked.layers.albedo[3 * size_t{pixel} + 1]) / wanted);
        before += logBefore * logBefore;
        after += logAfter * logAfter;
        count += 1.0;
    }
    EXPECT_LT(std::sqrt(after / count), 0.4 * std::sqrt(before / count));
}

TEST(Delight, EmittingTexelsGoToTheEmissionAndAreNoAlbedo)
{
    const Scan scan = panelRoom();
    const PageLayers layers = work(scan, thesis()).layers;
    const Radiance radiance(scan.pages[0].image);
    ASSERT_FALSE(layers.emission.empty());
    size_t shining = 0;
    for (size_t i = 0; i < scan.pages[0].image.pixels(); ++i) {
        if (radiance[i].g < 0.999f) continue;
        EXPECT_EQ(layers.emission[3 * i], 255);
        EXPECT_EQ(layers.confidence[i], 0);
        EXPECT_EQ(layers.doubt[i], Doubt::shines);
        ++shining;
    }
    EXPECT_GT(shining, 100u);
    EXPECT_NEAR(layers.area[static_cast<size_t>(Doubt::shines)], 0.64, 0.06); // m^2
}

TEST(Delight, IsTheSameOnOneThreadAndOnEight)
{
    const Scan scan = panelRoom();
    const auto run = [&](int threads, Solver solver) {
        const ThreadLimit limit(threads);
        return work(scan, {.solver = solver}).layers;
    };
    for (const Solver solver : {Solver::gather, Solver::thesis}) {
        const PageLayers one = run(1, solver);
        const PageLayers eight = run(8, solver);
        EXPECT_EQ(one.albedo, eight.albedo);
        EXPECT_EQ(one.direct, eight.direct);
        EXPECT_EQ(one.indirect, eight.indirect);
        EXPECT_EQ(one.confidence, eight.confidence);
        EXPECT_EQ(one.doubt, eight.doubt);
        EXPECT_EQ(one.area, eight.area);
    }
}

TEST(Delight, WithoutLpvAndAmbientOnlyDirectLightIsLeft)
{
    DelightOptions options = thesis();
    options.thesis.useLpv = false;
    options.thesis.useAmbient = false;
    const PageLayers layers = work(panelRoom(), options).layers;
    EXPECT_THAT(layers.indirect, testing::Each(0));
}

TEST(Delight, StopsWhereItIsWhenCancelled)
{
    const Scan scan = panelRoom();
    Progress progress;
    progress.cancel();
    try {
        delight(scenes::copyOf(scan), {}, progress);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

// Whoever gave the scan may forget it: a result has all that its layers are made of.
TEST(Delight, AResultKeepsItsScan)
{
    Progress progress;
    auto scan = std::make_shared<const Scan>(panelRoom());
    const std::weak_ptr<const Scan> watched = scan;
    std::optional<Decomposition> found = delight(std::move(scan), thesis(), progress);
    ASSERT_FALSE(watched.expired());
    EXPECT_EQ(found->scan(), watched.lock());
    EXPECT_EQ(found->layers(0, progress).albedo,
              delight(panelRoom(), thesis(), progress).layers(0, progress).albedo);
    found.reset();
    EXPECT_TRUE(watched.expired());
}

// The wall x = 0 and the floor of a box say where they are and look into it.
TEST(Delight, TexelsKnowTheirPlace)
{
    Progress progress;
    const Decomposition found = delight(panelRoom(), thesis(), progress);
    const PageGeometry geometry = found.geometry(0);
    const auto place = pixelView(geometry.positions, geometry.width, geometry.height);
    const auto normal = pixelView(geometry.normals, geometry.width, geometry.height);
    ASSERT_EQ(place.channels, 3);
    size_t covered = 0;
    for (int row = 0; row < place.height; ++row)
        for (int column = 0; column < place.width; ++column) {
            const glm::vec3 p(place.at(row, column, 0), place.at(row, column, 1),
                              place.at(row, column, 2));
            const glm::vec3 n(normal.at(row, column, 0), normal.at(row, column, 1),
                              normal.at(row, column, 2));
            if (n == glm::vec3(0.0f)) {
                ASSERT_EQ(p, glm::vec3(0.0f));
                continue;
            }
            ++covered;
            ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
            const glm::vec3 wall = glm::mix(kRoom, glm::vec3(0.0f), 0.5f * (n + 1.0f));
            ASSERT_NEAR(glm::dot(p - wall, n), 0.0f, 1e-4f); // walls stand where normals come from
        }
    EXPECT_EQ(covered, found.texelCount());
}

TEST(PixelView, StridesLeadToWhatIsThere)
{
    const std::vector<int> values{0, 1, 2, 10, 11, 12, 20, 21, 22, 30, 31, 32}; // 2 x 2, RGB
    const PixelView<int> view = pixelView(values, 2, 2);
    EXPECT_EQ(view.channels, 3);
    EXPECT_EQ(view.at(1, 0, 2), 22);
    const PixelView<int> green = view.channel(1).part(0, 1, 2, 1);
    EXPECT_EQ(green.at(0, 0), 11);
    EXPECT_EQ(green.at(1, 0), 31);
    EXPECT_EQ(green.first, &values[4]);
}

// Lights that were written and read again give what they gave.
TEST(Delight, ItsOwnLightsGivenBackChangeNothing)
{
    const Scan scan = panelRoom();
    Progress progress;
    for (const Solver solver : {Solver::gather, Solver::thesis}) {
        DelightOptions options{.solver = solver};
        const Decomposition first = delight(scenes::copyOf(scan), options, progress);
        options.lights = first.lights();
        const Decomposition second = delight(scenes::copyOf(scan), options, progress);
        const PageLayers a = first.layers(0, progress);
        const PageLayers b = second.layers(0, progress);
        for (size_t i = 0; i < a.albedo.size(); i += 97)
            ASSERT_NEAR(floatFromHalf(b.albedo[i]), floatFromHalf(a.albedo[i]),
                        0.01f * floatFromHalf(a.albedo[i]) + 1e-4f);
    }
}

TEST(Delight, SaysWhereOpeningsAreThoseOfAnotherScan)
{
    Progress progress;
    DelightOptions options;
    options.gather.quality = Quality::draft;
    options.lights = delight(panelRoom(), options, progress).lights();
    const auto warned = [&] {
        const std::vector<std::string> warnings =
            delight(panelRoom(), options, progress).warnings();
        return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
            return warning.find("parts of what lies outside") != std::string::npos;
        });
    };
    EXPECT_FALSE(warned());
    options.lights->openings.resize(options.lights->openings.size() + 2, glm::vec3(1.0f));
    EXPECT_TRUE(warned());
}

TEST(Delight, ADeviceThatGaveUpLeavesTheLayersToTheCpu)
{
    const Scan scan = panelRoom();
    Progress progress;
    const Decomposition found = delight(scenes::copyOf(scan), thesis(), progress);
    auto state = std::make_unique<Decomposition::State>(found.state());
    bool isAsked = false;
    state->solution.onDevice = [&](size_t, const SolvedTexels&, const AlbedoOptions&, Progress&) {
        isAsked = true;
        return std::optional<PageLayers>();
    };
    EXPECT_EQ(Decomposition(std::move(state)).layers(0, progress).albedo,
              found.layers(0, progress).albedo);
    EXPECT_TRUE(isAsked);
}

} // namespace relamp
