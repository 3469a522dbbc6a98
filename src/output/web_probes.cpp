#include "output/web_probes.h"

#include "output/air_probes.h"
#include "output/web_bytes.h"
#include "output/web_clusters.h"
#include "relight/relighter_state.h"
#include "scan/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relamp
{
namespace
{

constexpr float kLeastSpacing = 0.4f;  // m
constexpr float kMostProbes = 1024;    // a row each of a texture
constexpr size_t kRaysToClusters = 64; // of a probe

/// Places in the middles of cells that fill a box.
struct Lattice
{
    explicit Lattice(const Bounds& box)
    {
        const auto cells = [&] { return glm::max(glm::round(box.extent() / spacing), 1.0f); };
        while (cells().x * cells().y * cells().z > kMostProbes) spacing *= 1.05f;
        count = glm::ivec3(cells());
        low = box.centre() - 0.5f * spacing * (glm::vec3(count) - 1.0f);
    }

    [[nodiscard]] std::vector<glm::vec3> places() const
    {
        std::vector<glm::vec3> all;
        for (int z = 0; z < count.z; ++z)
            for (int y = 0; y < count.y; ++y)
                for (int x = 0; x < count.x; ++x) all.push_back(low + spacing * glm::vec3(x, y, z));
        return all;
    }

    float spacing = kLeastSpacing;
    glm::ivec3 count{1};
    glm::vec3 low{0.0f};
};

/// For each place the nearest that lies in the open: what is asked beside a wall lies between one
/// before and one behind it.
std::vector<uint32_t> openOnes(const std::vector<glm::vec3>& places,
                               const std::vector<uint8_t>& isOpen)
{
    std::vector<uint32_t> from(places.size());
    for (uint32_t i = 0; i < places.size(); ++i) {
        from[i] = i;
        if (isOpen[i] != 0) continue;
        float least = 1e30f;
        for (uint32_t k = 0; k < places.size(); ++k) {
            const glm::vec3 way = places[k] - places[i];
            if (isOpen[k] == 0 || glm::dot(way, way) >= least) continue;
            least = glm::dot(way, way);
            from[i] = k;
        }
    }
    return from;
}

/// The cluster that a ray meets; their number where it meets nothing.
class ClusterLookup
{
public:
    explicit ClusterLookup(const Relighter::State& room)
        : room_(room), clusters_(webClusters(room.transport, room.texels.surfels)),
          sideOf_(2 * room.texels.surfels.count(), -1)
    {
        for (size_t i = 0; i < room.transport.sides.size(); ++i)
            sideOf_[room.transport.sides[i].index] = static_cast<int32_t>(i);
    }

    [[nodiscard]] uint16_t along(const Ray& ray) const
    {
        const auto nothing = static_cast<uint16_t>(clusters_.count);
        const Hit hit = room_.scene.intersect(ray);
        if (hit.missed()) return nothing;
        const uint32_t surfel = room_.texels.surfels.find(ray.origin + hit.distance * ray.direction,
                                                          normalAt(room_.texels, hit));
        if (surfel == Surfels::kNone) return nothing;
        const Side side = hit.front ? Side::front(surfel) : Side::back(surfel);
        const int32_t known = sideOf_[side.index];
        return known < 0 ? nothing
                         : static_cast<uint16_t>(clusters_.ofSide[static_cast<size_t>(known)]);
    }

private:
    const Relighter::State& room_;
    WebClusters clusters_;
    std::vector<int32_t> sideOf_; // of the transport; -1: not there
};

float scaleOf(const std::vector<WebHarmonics>& light)
{
    float most = 0.0f;
    for (const WebHarmonics& one : light)
        most = std::max({most, one.of[0].r, one.of[0].g, one.of[0].b});
    return most > 0.0f ? most : 1.0f;
}

void addHarmonics(std::vector<uint8_t>& bytes, const WebHarmonics& light, float scale)
{
    const auto byteOf = [](float share) {
        return static_cast<uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
    };
    for (size_t i = 0; i < WebHarmonics::kCount; ++i)
        for (int c = 0; c < 3; ++c) {
            const float mean = std::max(light.of[0][c], 0.0f);
            if (i == 0) {
                bytes.push_back(byteOf(std::sqrt(std::sqrt(mean / scale))));
                continue;
            }
            const float most = std::sqrt(i < 4 ? 3.0f : 5.0f) * std::max(mean, 1e-20f);
            bytes.push_back(byteOf(0.5f + 0.5f * light.of[i][c] / most));
        }
}

} // namespace

struct WebProbes::State
{
    explicit State(const Relighter& relighter)
        : lattice(relighter.state().scene.bounds()), places(lattice.places()),
          probes(relighter, places), from(openOnes(places, probes.isOpen()))
    {
        const ClusterLookup lookup(relighter.state());
        for (const uint32_t place : from)
            for (size_t i = 0; i < kRaysToClusters; ++i)
                addWord(bytes,
                        lookup.along({places[place], webDirectionOfRay(i, kRaysToClusters)}));
    }

    Lattice lattice;
    std::vector<glm::vec3> places;
    AirProbes probes;
    std::vector<uint32_t> from; // of places, whose light they have
    std::vector<uint8_t> bytes;
    std::vector<float> scales; // of lights
};

WebProbes::WebProbes(const Relighter& relighter) : state_(std::make_unique<State>(relighter)) {}

WebProbes::~WebProbes() = default;

void WebProbes::add()
{
    const std::vector<WebHarmonics> light = state_->probes.light();
    const float scale = scaleOf(light);
    state_->scales.push_back(scale);
    for (const uint32_t place : state_->from) addHarmonics(state_->bytes, light[place], scale);
}

std::span<const uint8_t> WebProbes::bytes() const
{
    return state_->bytes;
}

nlohmann::ordered_json WebProbes::json() const
{
    const Lattice& lattice = state_->lattice;
    return {{"low", {lattice.low.x, lattice.low.y, lattice.low.z}},
            {"spacing", lattice.spacing},
            {"count", {lattice.count.x, lattice.count.y, lattice.count.z}},
            {"rays", kRaysToClusters},
            {"scales", state_->scales}};
}

} // namespace relamp
