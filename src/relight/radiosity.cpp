#include "relight/radiosity.h"

#include "base/parallel.h"
#include "lights/expand.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;
constexpr int kMostBounces = 64;
constexpr int kFewestBounces = 3;  // before their series can be told
constexpr float kUnseen = 2e-3f;   // of all light
constexpr float kSlowest = 0.95f;  // ratio of a series that is believed
constexpr size_t kStepOfSides = 4; // of its rays, one that is asked what a side sends on
constexpr size_t kChunk = 1024;

/// The fourth is the square of the luminance, which gathering sums up along with the colours.
glm::vec4 withSquare(glm::vec3 radiance)
{
    const float brightness = luminance(radiance);
    return {radiance, brightness * brightness};
}

class Bouncer
{
public:
    Bouncer(const Transport& transport, std::span<const glm::vec3> albedo,
            std::span<const glm::vec3> direct, std::span<const glm::vec3> sky);

    Bounced run();

private:
    float bounceOnce();
    float send(float stretch);
    [[nodiscard]] std::vector<glm::vec4> radianceOfSides();
    void arrive(Bounced& bounced);

    const Transport& transport_;
    std::span<const glm::vec3> albedoOfSurfels_;
    std::span<const glm::vec3> direct_;
    std::span<const glm::vec3> sky_;
    std::vector<glm::vec3> albedo_;     // of clusters
    std::vector<glm::vec3> source_;     // radiance of clusters by direct light
    std::vector<glm::vec4> radiance_;   // of clusters, sky, nothing
    std::vector<glm::vec4> irradiance_; // on clusters
    float total_ = 0.0f;                // mean luminance of all that is sent
};

Bouncer::Bouncer(const Transport& transport, std::span<const glm::vec3> albedo,
                 std::span<const glm::vec3> direct, std::span<const glm::vec3> sky)
    : transport_(transport), albedoOfSurfels_(albedo), direct_(direct), sky_(sky),
      albedo_(transport.clusters(), glm::vec3(0.0f)),
      source_(transport.clusters(), glm::vec3(0.0f)),
      radiance_(transport.clusters() + Transport::radiancesBeyond(), glm::vec4(0.0f)),
      irradiance_(transport.clusters(), glm::vec4(0.0f))
{
    for (size_t i = 0; i < transport.sides.size(); ++i) {
        const uint32_t cluster = transport.clusterOf[i];
        const glm::vec3 share = transport.weight[i] * albedo[transport.sides[i].surfel()];
        albedo_[cluster] += share;
        source_[cluster] += share * direct[i] / kPi;
    }
    for (size_t bin = 0; bin < sky.size(); ++bin)
        radiance_[transport.clusters() + bin] = withSquare(sky[bin]);
}

/// Lets everything send what it receives, `stretch` times the change. Returns the mean change.
float Bouncer::send(float stretch)
{
    const size_t clusters = transport_.clusters();
    std::vector<glm::dvec2> sums((clusters + kChunk - 1) / kChunk, glm::dvec2(0.0));
    forEachChunk(clusters, kChunk, [&](size_t begin, size_t end) {
        glm::dvec2 sum(0.0);
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 before(radiance_[i]);
            const glm::vec3 after = source_[i] + albedo_[i] * glm::vec3(irradiance_[i]) / kPi;
            const glm::vec3 change = after - before;
            radiance_[i] = withSquare(glm::max(before + stretch * change, glm::vec3(0.0f)));
            sum += glm::dvec2(std::abs(luminance(change)), luminance(after));
        }
        sums[begin / kChunk] = sum;
    });
    glm::dvec2 all(0.0);
    for (const glm::dvec2& sum : sums) all += sum; // in order: the same on any machine
    total_ = static_cast<float>(all.y / static_cast<double>(clusters));
    return static_cast<float>(all.x / static_cast<double>(clusters));
}

float Bouncer::bounceOnce()
{
    transport_.ofClusters.gather(radiance_, irradiance_);
    return send(1.0f);
}

/// What every side sends of its own direct light and of what comes from others: to its cluster,
/// and then, for that mixes what lies open and what is hidden, to itself.
std::vector<glm::vec4> Bouncer::radianceOfSides()
{
    transport_.ofClusters.gather(radiance_, irradiance_);
    const size_t sides = transport_.sides.size();
    std::vector<glm::vec4> radiance(sides + Transport::radiancesBeyond(), glm::vec4(0.0f));
    forEachChunk(sides, kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 received = direct_[i] + glm::vec3(irradiance_[transport_.clusterOf[i]]);
            radiance[i] =
                withSquare(albedoOfSurfels_[transport_.sides[i].surfel()] * received / kPi);
        }
    });
    for (size_t bin = 0; bin < sky_.size(); ++bin) radiance[sides + bin] = withSquare(sky_[bin]);

    const SightLists& lists = transport_.ofFronts;
    std::vector<glm::vec4> irradiance(lists.count());
    lists.gather(radiance, irradiance, kStepOfSides);
    forEachChunk(lists.count(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            radiance[i] =
                withSquare(albedoOfSurfels_[i] * (direct_[i] + glm::vec3(irradiance[i])) / kPi);
    });
    return radiance;
}

void Bouncer::arrive(Bounced& bounced)
{
    const SightLists& lists = transport_.ofFronts;
    std::vector<glm::vec4> irradiance(lists.count());
    lists.gather(radianceOfSides(), irradiance);
    bounced.irradiance.resize(lists.count());
    bounced.noise.resize(lists.count());
    forEachChunk(lists.count(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            bounced.irradiance[i] = glm::vec3(irradiance[i]);
            const float mean = luminance(bounced.irradiance[i]) / kPi;
            const auto rays = static_cast<float>(lists.first[i + 1] - lists.first[i]);
            const float variance = std::max(irradiance[i].w / kPi - mean * mean, 0.0f);
            bounced.noise[i] = kPi * std::sqrt(variance / rays);
        }
    });
}

Bounced Bouncer::run()
{
    Bounced bounced;
    float last = bounceOnce(); // the light of the sky, and what is lit directly
    for (; bounced.bounces < kMostBounces && last > 0.0f; ++bounced.bounces) {
        const float change = bounceOnce();
        const float ratio = std::min(change / last, kSlowest);
        const float rest = change * ratio / (1.0f - ratio);
        last = change;
        if (bounced.bounces + 1 < kFewestBounces || rest > 5.0f * kUnseen * total_) continue;
        // What is to come is the last change again and again, each time a ratio of it.
        transport_.ofClusters.gather(radiance_, irradiance_);
        send(1.0f / (1.0f - ratio));
        break;
    }
    arrive(bounced);
    return bounced;
}

} // namespace

Bounced bounce(const Transport& transport, std::span<const glm::vec3> albedo,
               std::span<const glm::vec3> direct, std::span<const glm::vec3> sky)
{
    return Bouncer(transport, albedo, direct, sky).run();
}

} // namespace relamp
