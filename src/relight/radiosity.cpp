#include "relight/radiosity.h"

#include "base/parallel.h"
#include "lights/expand.shared.h"
#include "relight/sky_bins.h"

#include <algorithm>
#include <cmath>

#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;
constexpr int kMostBounces = 64;
constexpr int kFewestBounces = 3; // before their series can be told
constexpr float kUnseen = 2e-3f;  // of all light
constexpr float kSlowest = 0.95f; // ratio of a series that is believed
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
    float step(float stretch);
    void gather(bool isFew) { gatherRadiance(transport_, radiance_, isFew, irradiance_); }

    const Transport& transport_;
    std::span<const glm::vec3> albedo_;
    std::span<const glm::vec3> direct_;
    std::vector<glm::vec4> radiance_;
    std::vector<glm::vec4> irradiance_;
    float total_ = 0.0f; // mean luminance of all that leaves
};

Bouncer::Bouncer(const Transport& transport, std::span<const glm::vec3> albedo,
                 std::span<const glm::vec3> direct, std::span<const glm::vec3> sky)
    : transport_(transport), albedo_(albedo), direct_(direct),
      radiance_(transport.radiances(), glm::vec4(0.0f)),
      irradiance_(transport.lists(), glm::vec4(0.0f))
{
    for (size_t bin = 0; bin < sky.size(); ++bin)
        radiance_[transport.lists() + bin] = withSquare(sky[bin]);
}

/// Lets everything send what it receives, `stretch` times the change. Returns the mean change.
float Bouncer::step(float stretch)
{
    const size_t lists = transport_.lists();
    const size_t chunks = (lists + kChunk - 1) / kChunk;
    std::vector<glm::dvec2> sums(chunks, glm::dvec2(0.0)); // in order: the same on any machine
    forEachChunk(lists, kChunk, [&](size_t begin, size_t end) {
        glm::dvec2 sum(0.0);
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 before(radiance_[i]);
            const glm::vec3 after = albedo_[transport_.sides[i].surfel()] *
                                    (direct_[i] + glm::vec3(irradiance_[i])) / kPi;
            const glm::vec3 change = after - before;
            radiance_[i] = withSquare(glm::max(before + stretch * change, glm::vec3(0.0f)));
            sum += glm::dvec2(std::abs(luminance(change)), luminance(after));
        }
        sums[begin / kChunk] = sum;
    });
    glm::dvec2 all(0.0);
    for (const glm::dvec2& sum : sums) all += sum;
    total_ = static_cast<float>(all.y / static_cast<double>(lists));
    return static_cast<float>(all.x / static_cast<double>(lists));
}

Bounced Bouncer::run()
{
    Bounced bounced;
    const bool hasSky =
        std::any_of(radiance_.begin() + static_cast<std::ptrdiff_t>(transport_.lists()),
                    radiance_.end(), [](glm::vec4 r) { return r.w > 0.0f; });
    if (hasSky) gather(true);
    float last = step(1.0f);
    for (; bounced.bounces < kMostBounces && last > 0.0f; ++bounced.bounces) {
        gather(true);
        const float change = step(1.0f);
        const float ratio = std::min(change / last, kSlowest);
        const float rest = change * ratio / (1.0f - ratio);
        last = change;
        if (bounced.bounces + 1 < kFewestBounces || rest > 5.0f * kUnseen * total_) continue;
        // What is to come is the last change again and again, each time a ratio of it.
        gather(true);
        step(1.0f / (1.0f - ratio));
        break;
    }
    gather(false);
    bounced.irradiance.resize(transport_.lists());
    bounced.noise.resize(transport_.lists());
    forEachChunk(transport_.lists(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            bounced.irradiance[i] = glm::vec3(irradiance_[i]);
            const float mean = luminance(bounced.irradiance[i]) / kPi;
            const auto rays = static_cast<float>(transport_.first[i + 1] - transport_.first[i]);
            const float variance = std::max(irradiance_[i].w / kPi - mean * mean, 0.0f);
            bounced.noise[i] = kPi * std::sqrt(variance / rays);
        }
    });
    return bounced;
}

} // namespace

Bounced bounce(const Transport& transport, std::span<const glm::vec3> albedo,
               std::span<const glm::vec3> direct, std::span<const glm::vec3> sky)
{
    return Bouncer(transport, albedo, direct, sky).run();
}

} // namespace relamp
