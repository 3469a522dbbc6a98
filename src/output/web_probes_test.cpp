#include "output/web_probes.h"

#include "base/radiometry.shared.h"
#include "output/air_probes.h"
#include "output/web_direction.h"
#include "relight/relighter_state.h"
#include "scenes/lit_room.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

class WebProbesOfARoom : public testing::Test
{
protected:
    DelitRoom room = scenes::litDelitRoom("panel");
};

glm::vec3 decoded(std::span<const uint8_t> bytes, float scale, glm::vec3 normal)
{
    WebHarmonics light;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<size_t>(c);
        light.of[0][c] = scale * std::pow(static_cast<float>(bytes[channel]) / 255.0f, 4.0f);
        for (size_t i = 1; i < WebHarmonics::kCount; ++i)
            light.of[i][c] = light.of[0][c] * std::sqrt(i < 4 ? 3.0f : 5.0f) *
                             (static_cast<float>(bytes[3 * i + channel]) / 127.5f - 1.0f);
    }
    return light.shading(normal);
}

} // namespace

// apps/web/test holds the browser's to the same numbers.
TEST(WebHarmonics, AreAsThePageHasThem)
{
    std::ifstream file(std::string(RELAMP_SAMPLES) + "/../apps/web/test/formulas.json");
    const nlohmann::json numbers = nlohmann::json::parse(file);
    ASSERT_GE(numbers["rays"].size(), 5u);
    ASSERT_GE(numbers["words"].size(), 5u);
    for (const nlohmann::json& row : numbers["rays"]) {
        const glm::vec3 direction =
            webDirectionOfRay(row["i"].get<size_t>(), row["count"].get<size_t>());
        const auto basis = WebHarmonics::basis(direction);
        for (size_t i = 0; i < basis.size(); ++i)
            EXPECT_NEAR(basis[i], row["harmonics"][i].get<float>(), 1e-4f) << row;
    }
    for (const nlohmann::json& row : numbers["words"]) {
        const glm::vec3 direction = fromWebDirection(row["word"].get<uint16_t>());
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(direction[axis], row["direction"][static_cast<size_t>(axis)].get<float>(),
                        1e-5f)
                << row;
    }
}

// Under an even sky all around, radiance L: irradiance is pi L whichever way a surface faces.
TEST(WebHarmonics, OfAnEvenSkyGiveItsRadiance)
{
    constexpr size_t kRays = 2048;
    WebHarmonics light;
    for (size_t i = 0; i < kRays; ++i)
        light.add(webDirectionOfRay(i, kRays), glm::vec3(2.0f * 4.0f * kPi / kRays));
    for (size_t i = 0; i < 20; ++i)
        EXPECT_NEAR(light.shading(webDirectionOfRay(i, 20)).g, 2.0f, 0.02f);
}

// A lamp far away in one direction, irradiance E: nine harmonics have the cosine to a tenth of E.
TEST(WebHarmonics, OfOneDirectionAreItsCosine)
{
    const glm::vec3 towards = glm::normalize(glm::vec3(1.0f, 2.0f, -1.0f));
    WebHarmonics light;
    light.add(towards, glm::vec3(kPi));
    for (size_t i = 0; i < 100; ++i) {
        const glm::vec3 normal = webDirectionOfRay(i, 100);
        EXPECT_NEAR(light.shading(normal).r, std::max(glm::dot(normal, towards), 0.0f), 0.1f);
    }
}

// A white surface in the air next to a wall receives what the gatherer has the wall receive.
TEST_F(WebProbesOfARoom, NextToAWallHaveItsIrradiance)
{
    Relighter relighter(room, {.rays = 64});
    relighter.glance(asCaptured(room.captured));
    const Surfels& surfels = relighter.state().texels.surfels;
    std::vector<glm::vec3> places;
    std::vector<size_t> of;
    for (size_t s = 0; s < surfels.count(); s += 23) {
        if (surfels.normal[s].y < -0.5f)
            continue; // beside the panel on the ceiling it is not smooth
        places.push_back(surfels.position[s] + 0.02f * surfels.normal[s]);
        of.push_back(s);
    }
    ASSERT_GT(places.size(), 100u);
    const AirProbes probes(relighter, places);
    const std::vector<WebHarmonics> light = probes.light();
    double apart = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < of.size(); ++i) {
        const float wanted = luminance(relighter.state().radiosity.onFronts()[of[i]]) / kPi;
        const float found = luminance(light[i].shading(surfels.normal[of[i]]));
        apart += std::abs(static_cast<double>(found - wanted));
        all += static_cast<double>(wanted);
        EXPECT_TRUE(probes.isOpen()[i]);
    }
    EXPECT_LT(apart / all, 0.08);
}

/// What a page reads of the bytes of one light.
class PageOfProbes
{
public:
    explicit PageOfProbes(const WebProbes& written)
        : low_(vectorOf(written.json()["low"])), count_(vectorOf(written.json()["count"])),
          spacing_(written.json()["spacing"].get<float>()),
          scale_(written.json()["scales"][0].get<float>())
    {
        const auto probes = static_cast<size_t>(count_.x) * static_cast<size_t>(count_.y) *
                            static_cast<size_t>(count_.z);
        const size_t words = 2 * probes * written.json()["rays"].get<size_t>();
        EXPECT_EQ(written.bytes().size(), words + 27 * probes);
        light_ = written.bytes().subspan(words);
    }

    [[nodiscard]] glm::vec3 shading(glm::vec3 place, glm::vec3 normal) const
    {
        const glm::vec3 at = (place - low_) / spacing_;
        const glm::vec3 begin = glm::floor(at);
        glm::vec3 sum(0.0f);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::vec3 share = glm::mix(1.0f - (at - begin), at - begin, step);
            const glm::vec3 cell = begin + step;
            const auto probe =
                static_cast<size_t>((cell.z * count_.y + cell.y) * count_.x + cell.x);
            sum += share.x * share.y * share.z *
                   decoded(light_.subspan(27 * probe, 27), scale_, normal);
        }
        return sum;
    }

private:
    static glm::vec3 vectorOf(const nlohmann::ordered_json& list)
    {
        return {list[0].get<float>(), list[1].get<float>(), list[2].get<float>()};
    }

    glm::vec3 low_;
    glm::vec3 count_;
    float spacing_;
    float scale_;
    std::span<const uint8_t> light_;
};

// In the air, what a page mixes of the probes around is what a probe in that very place has.
TEST_F(WebProbesOfARoom, BetweenThemAreWhatIsThere)
{
    Relighter relighter(room, {.rays = 16});
    WebProbes written(relighter);
    relighter.glance(asCaptured(room.captured));
    written.add();
    const PageOfProbes page(written);
    std::vector<glm::vec3> places;
    for (int i = 0; i < 60; ++i) {
        const glm::vec3 u = glm::fract(static_cast<float>(i) * glm::vec3(0.819f, 0.671f, 0.549f));
        places.push_back(glm::vec3(0.5f) + u * (scenes::LitRoom::kSize - glm::vec3(1.0f)));
    }
    const std::vector<WebHarmonics> wanted = AirProbes(relighter, places).light();
    double apart = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < places.size(); ++i)
        for (size_t k = 0; k < 6; ++k) {
            const glm::vec3 normal = webDirectionOfRay(k, 6);
            const float there = wanted[i].shading(normal).g;
            apart += std::abs(page.shading(places[i], normal).g - there);
            all += there;
        }
    EXPECT_LT(apart / all, 0.05);
}

} // namespace relamp
