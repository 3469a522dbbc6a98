#include "relight/radiosity.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "relight/follow_bounces.h"
#include "relight/radiosity.shared.h"
#include "shading/gather.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

constexpr size_t kSurfelChunk = 1024;

/// The fourth is the square of the luminance, which gathering sums up along with the colours.
glm::vec4 withSquare(glm::vec3 radiance)
{
    const float brightness = luminance(radiance);
    return {radiance, brightness * brightness};
}

/// The light goes from bounce to bounce by itself, so that what a bounce adds is known.
class Bouncer
{
public:
    Bouncer(const Transport& transport, std::span<const glm::vec3> albedo,
            std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
            const KnownLight& known);

    Bounced run();

private:
    [[nodiscard]] float meanSent() const;
    float bounceOnce(size_t step, float weight);
    /// What a side shows of its direct light to rays that are to meet it.
    [[nodiscard]] glm::vec3 metDirect(size_t side) const
    {
        if (known_.direct.empty()) return direct_[side];
        return glm::max(direct_[side] - known_.direct[side], 0.0f); // but for rounding
    }
    [[nodiscard]] std::vector<glm::vec4> radianceOfSides();
    void arrive(Bounced& bounced);

    const Transport& transport_;
    std::span<const glm::vec3> albedoOfSurfels_;
    std::span<const glm::vec3> direct_;
    std::span<const glm::vec3> sky_;
    const KnownLight& known_;
    std::vector<glm::vec3> albedo_;     // of clusters
    std::vector<glm::vec4> sent_;       // radiance of clusters, sky, nothing, by the last bounce
    std::vector<glm::vec4> arriving_;   // irradiance on clusters by that
    std::vector<glm::vec3> irradiance_; // on clusters, by all bounces
};

Bouncer::Bouncer(const Transport& transport, std::span<const glm::vec3> albedo,
                 std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
                 const KnownLight& known)
    : transport_(transport), albedoOfSurfels_(albedo), direct_(direct), sky_(sky), known_(known),
      albedo_(transport.clusters(), glm::vec3(0.0f)),
      sent_(transport.clusters() + Transport::radiancesBeyond(), glm::vec4(0.0f)),
      arriving_(transport.clusters(), glm::vec4(0.0f)),
      irradiance_(transport.clusters(), glm::vec3(0.0f))
{
    for (size_t i = 0; i < transport.sides.size(); ++i) {
        const uint32_t cluster = transport.clusterOf[i];
        const glm::vec3 share = transport.weight[i] * albedo[transport.sides[i].surfel()];
        albedo_[cluster] += share;
        sent_[cluster] += glm::vec4(sentOn(share, direct[i]), 0.0f);
    }
    for (size_t bin = 0; bin < sky.size(); ++bin)
        sent_[transport.clusters() + bin] = glm::vec4(sky[bin], 0.0f);
}

/// Mean luminance of what clusters send.
float Bouncer::meanSent() const
{
    const size_t clusters = transport_.clusters();
    double sum = 0.0;
    for (size_t i = 0; i < clusters; ++i)
        sum += static_cast<double>(luminance(glm::vec3(sent_[i])));
    return static_cast<float>(sum / static_cast<double>(clusters));
}

/// Lets everything receive what was sent, which counts `weight` times, and send it on. Returns
/// meanSent().
float Bouncer::bounceOnce(size_t step, float weight)
{
    transport_.ofClusters.gather(sent_, arriving_, step);
    const size_t clusters = transport_.clusters();
    forEachChunk(clusters, kSurfelChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 arriving(arriving_[i]);
            const glm::vec3 sent = sentOn(albedo_[i], arriving);
            irradiance_[i] += weight * arriving;
            sent_[i] = glm::vec4(sent, 0.0f);
        }
    });
    std::fill(sent_.begin() + static_cast<std::ptrdiff_t>(clusters), sent_.end(), glm::vec4(0.0f));
    return meanSent();
}

/// What every side sends of its own direct light and of what comes from others: to its cluster,
/// and then, for that mixes what lies open and what is hidden, to itself.
std::vector<glm::vec4> Bouncer::radianceOfSides()
{
    const size_t sides = transport_.sides.size();
    std::vector<glm::vec4> radiance(sides + Transport::radiancesBeyond(), glm::vec4(0.0f));
    forEachChunk(sides, kSurfelChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            radiance[i] = withSquare(sentOn(albedoOfSurfels_[transport_.sides[i].surfel()],
                                            metDirect(i) + irradiance_[transport_.clusterOf[i]]));
    });
    for (size_t bin = 0; bin < sky_.size(); ++bin) radiance[sides + bin] = withSquare(sky_[bin]);

    const SightLists& lists = transport_.ofFronts;
    std::vector<glm::vec4> irradiance(lists.count());
    lists.gather(radiance, irradiance, kStepOfSides);
    forEachChunk(lists.count(), kSurfelChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 received = metDirect(i) + glm::vec3(irradiance[i]);
            if (!known_.irradiance.empty()) received += known_.irradiance[i];
            radiance[i] = withSquare(sentOn(albedoOfSurfels_[i], received));
        }
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
    forEachChunk(lists.count(), kSurfelChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            bounced.irradiance[i] = glm::vec3(irradiance[i]);
            const auto rays = static_cast<float>(lists.first[i + 1] - lists.first[i]);
            const float all = rays / kPi; // the sum over rays, of a mean times pi
            bounced.noise[i] =
                noiseOfRays(all * luminance(bounced.irradiance[i]), all * irradiance[i].w, rays);
        }
    });
}

Bounced Bouncer::run()
{
    Bounced bounced;
    bounced.bounces = followBounces(
        meanSent(), [&](size_t step, float weight) { return bounceOnce(step, weight); });
    arrive(bounced);
    return bounced;
}

} // namespace

Bounced bounce(const Transport& transport, std::span<const glm::vec3> albedo,
               std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
               const KnownLight& known)
{
    return Bouncer(transport, albedo, direct, sky, known).run();
}

} // namespace relamp
