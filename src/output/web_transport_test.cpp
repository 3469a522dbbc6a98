#include "output/web_transport.h"

#include "base/radiometry.shared.h"
#include "output/web_clusters.h"
#include "output/web_direction.h"
#include "relight/relighter_state.h"
#include "scenes/lit_room.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

struct WebSite
{
    glm::vec3 place;
    glm::vec3 normal;
};

/// What a page makes of the bytes, in the order in which it makes it.
class PageOfTransport
{
public:
    explicit PageOfTransport(const WebTransport& written)
        : bytes_(written.bytes), box_(written.json["box"]),
          count(written.json["clusters"].get<size_t>()),
          points(written.json["points"].get<size_t>()), rays(written.json["rays"].get<size_t>())
    {
        for (size_t i = 0; i < count; ++i) {
            sites.push_back(site());
            glm::vec3 root;
            for (int c = 0; c < 3; ++c) root[c] = static_cast<float>(byte()) / 255.0f;
            albedo.push_back(root * root);
        }
        for (size_t i = 0; i < count * points; ++i) places.push_back(site());
        for (size_t i = 0; i < count; ++i)
            for (size_t ray = 0, target = 0; ray < rays; ++ray) {
                uint8_t step = 255;
                for (; step == 255; target += step) step = byte();
                met.push_back(target);
            }
    }

    [[nodiscard]] bool isAtEnd() const { return at_ == bytes_.size(); }

    /// Irradiance / pi on clusters by way of surfaces, of what a point sends to what it sees.
    [[nodiscard]] std::vector<glm::vec3> bounced(glm::vec3 lamp, glm::vec3 intensity) const
    {
        std::vector<glm::vec3> direct(count, glm::vec3(0.0f));
        for (size_t i = 0; i < places.size(); ++i) {
            const glm::vec3 way = lamp - places[i].place;
            const float cosine = std::max(glm::dot(glm::normalize(way), places[i].normal), 0.0f);
            direct[i / points] +=
                cosine / glm::dot(way, way) / (kPi * static_cast<float>(points)) * intensity;
        }
        std::vector<glm::vec3> received(count, glm::vec3(0.0f));
        for (int bounce = 0; bounce < 40; ++bounce) {
            std::vector<glm::vec3> sent(count + 1, glm::vec3(0.0f));
            for (size_t i = 0; i < count; ++i) sent[i] = albedo[i] * (direct[i] + received[i]);
            for (size_t i = 0; i < count; ++i) {
                received[i] = glm::vec3(0.0f);
                for (size_t ray = 0; ray < rays; ++ray)
                    received[i] += sent[met[i * rays + ray]] / static_cast<float>(rays);
            }
        }
        return received;
    }

private:
    uint8_t byte() { return bytes_.at(at_++); }
    uint16_t word()
    {
        const uint16_t low = byte();
        return static_cast<uint16_t>(low | byte() << 8);
    }
    WebSite site()
    {
        WebSite read{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<size_t>(axis);
            read.place[axis] = box_["low"][i].get<float>() + box_["extent"][i].get<float>() *
                                                                 static_cast<float>(word()) /
                                                                 65535.0f;
        }
        read.normal = fromWebDirection(word());
        return read;
    }

    const std::vector<uint8_t>& bytes_;
    nlohmann::ordered_json box_;
    size_t at_ = 0;

public:
    size_t count;
    size_t points;
    size_t rays;
    std::vector<WebSite> sites; // of clusters
    std::vector<glm::vec3> albedo;
    std::vector<WebSite> places;
    std::vector<size_t> met;
};

class WebTransportOfARoom : public testing::Test
{
protected:
    DelitRoom room = scenes::litDelitRoom("panel");
};

} // namespace

TEST(WebDirection, IsItselfToADegree)
{
    for (int i = 0; i < 500; ++i) {
        const float z = 2.0f * (static_cast<float>(i) + 0.5f) / 500.0f - 1.0f;
        const float around = 2.4f * static_cast<float>(i);
        const float r = std::sqrt(1.0f - z * z);
        const glm::vec3 way(r * std::cos(around), r * std::sin(around), z);
        EXPECT_GT(glm::dot(fromWebDirection(webDirection(way)), way), std::cos(0.0175f));
    }
}

// The page's own sums against the relighter's finer ones; a factor of pi, or a bounce too few, is
// far more than the bound.
TEST_F(WebTransportOfARoom, BouncesLightAsTheRelighterDoes)
{
    Relighter relighter(room, {.rays = 64});
    const WebTransport written = webTransport(relighter);
    const PageOfTransport page(written);
    ASSERT_TRUE(page.isAtEnd());
    const glm::vec3 lamp(1.0f, 1.2f, 1.5f);
    const glm::vec3 intensity(3.0f, 2.0f, 1.0f);
    Relighting lighting;
    lighting.lights.push_back({.type = LightType::point, .emission = intensity, .position = lamp});
    relighter.glance(lighting);

    const Relighter::State& state = relighter.state();
    const Surfels& surfels = state.texels.surfels;
    const std::vector<glm::vec3> found = page.bounced(lamp, intensity);
    const WebClusters clusters = webClusters(state.transport, surfels);
    ASSERT_EQ(clusters.count, page.count);
    double squares = 0.0;
    double all = 0.0;
    for (size_t s = 0; s < surfels.count(); ++s) { // the front of surfel s is side s
        const glm::vec3 way = lamp - surfels.position[s];
        const float cosine = std::max(glm::dot(glm::normalize(way), surfels.normal[s]), 0.0f);
        const glm::vec3 direct = cosine / glm::dot(way, way) * intensity;
        const glm::vec3 wanted = (state.radiosity.onFronts()[s] - direct) / kPi;
        const glm::vec3 apart = found[clusters.ofSide[s]] - wanted;
        squares += static_cast<double>(surfels.area[s] * glm::dot(apart, apart));
        all += static_cast<double>(surfels.area[s] * glm::dot(wanted, wanted));
    }
    EXPECT_LT(std::sqrt(squares / all), 0.05);
}

} // namespace relamp
