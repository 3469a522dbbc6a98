#include "relight/glow.h"

#include "base/instruction_set.h"
#include "base/lanes.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/ramp.shared.h"
#include "scan/texels.h"
#include "shading/area_direct.shared.h"
#include "shading/lit_sides.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr double kBright = 8.0;  // times the room's mean
constexpr double kMatters = 0.2; // of all light that is sent
constexpr size_t kPatches = 128; // that stand for it where nothing is in the way
constexpr float kFar = 0.1f;     // of the view that it fills
constexpr float kNear = 0.3f;

struct OpenArgs
{
    const TexelBlock* block;
    const AreaLight* light;
    float gain;
    RgbBlock* out;
};

void openKernel(const OpenArgs& args)
{
    const TexelBlock& block = *args.block;
    const float area = args.light->area() / kPatches;
    for (size_t first = 0; first < block.count; first += kLanes) {
        float r[kLanes] = {};
        float g[kLanes] = {};
        float b[kLanes] = {};
        for (size_t j = 0; j < kPatches; ++j) {
            const ClippedPatch& patch =
                args.light->at((static_cast<float>(j) + 0.5f) / static_cast<float>(kPatches));
            const glm::vec3 radiance = args.gain * patch.radiance;
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way =
                    patch.position - glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                const float factor = area * patchFormFactor(way, normal, patch.normal, area);
                r[lane] += factor * radiance.r;
                g[lane] += factor * radiance.g;
                b[lane] += factor * radiance.b;
            }
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            args.out->r[first + lane] = r[lane];
            args.out->g[first + lane] = g[lane];
            args.out->b[first + lane] = b[lane];
        }
    }
}

/// Irradiance in the middle of surfels, nothing in the way.
std::vector<glm::vec3> openIrradiance(const Glow& glow, const Surfels& surfels)
{
    const AreaLight light(glow.patches);
    std::vector<glm::vec3> irradiance(surfels.count());
    forEachChunk(surfels.count(), TexelBlock::kCapacity, [&](size_t begin, size_t end) {
        TexelBlock block;
        RgbBlock rgb;
        loadSurfels(surfels, begin, end, block);
        const OpenArgs args{&block, &light, glow.gain, &rgb};
        runKernel<openKernel>(bestInstructionSet(), args);
        for (size_t i = 0; i < block.count; ++i)
            irradiance[begin + i] = {rgb.r[i], rgb.g[i], rgb.b[i]};
    });
    return irradiance;
}

/// Irradiance by what the rays of bounces happened to meet, and pi times the share of them that met
/// the glow: good where that is large, and few patches cannot stand for it.
std::vector<glm::vec4> metByRays(const Glow& glow, const Transport& transport,
                                 const Surfels& surfels)
{
    std::vector<glm::vec4> radiance(transport.sides.size() + Transport::radiancesBeyond(),
                                    glm::vec4(0.0f));
    for (size_t i = 0; i < glow.sides.size(); ++i) {
        const ClippedPatch& patch = glow.patches[i];
        const float sent = glow.gain * patch.area / surfels.area[patch.surfel];
        radiance[glow.sides[i]] = glm::vec4(sent * patch.radiance, 1.0f);
    }
    std::vector<glm::vec4> met(surfels.count());
    transport.ofFronts.gather(radiance, met);
    return met;
}

} // namespace

SentLight sentDirectly(const Transport& transport, const Surfels& surfels,
                       std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct)
{
    SentLight sent;
    for (size_t i = 0; i < transport.sides.size(); ++i) {
        const uint32_t s = transport.sides[i].surfel();
        sent.flux += static_cast<double>(surfels.area[s] * luminance(albedo[s] * direct[i]) / kPi);
        sent.area += static_cast<double>(surfels.area[s]);
    }
    return sent;
}

std::optional<Glow> findGlow(const Transport& transport, const Texels& texels,
                             std::span<const glm::vec3> albedo, const LampSight& ofLight,
                             glm::vec3 emission, const SentLight& all)
{
    if (all.flux <= 0.0) return {};
    const auto bright = static_cast<float>(kBright * all.flux / all.area);
    Glow glow;
    double flux = 0.0;
    for (uint32_t i = 0; i < transport.sides.size(); ++i) {
        const uint32_t s = transport.sides[i].surfel();
        const float sent = ofLight[i].visible * luminance(albedo[s] * emission) / kPi;
        if (sent <= bright) continue;
        glow.sides.push_back(i);
        flux += static_cast<double>(texels.surfels.area[s] * sent);
    }
    if (flux < kMatters * all.flux) return {};

    const SurfelSites sites(texels);
    double area = 0.0;
    double weights = 0.0;
    for (const uint32_t i : glow.sides) {
        const Side side = transport.sides[i];
        const uint32_t s = side.surfel();
        // Any texel, for the middle of a surfel may lie behind what it is the middle of.
        const TexelSite site = sites.at(s, s);
        const float reflected = luminance(albedo[s]);
        const float weight = texels.surfels.area[s] * ofLight[i].visible * reflected;
        glow.patches.push_back({site.position, side.isBack() ? -site.normal : site.normal, weight,
                                s, albedo[s] / (kPi * reflected)});
        area += static_cast<double>(texels.surfels.area[s]);
        weights += static_cast<double>(weight);
    }
    glow.gain = static_cast<float>(weights / area);
    for (ClippedPatch& patch : glow.patches) patch.area /= glow.gain;
    return glow;
}

std::vector<glm::vec3> irradianceFrom(const Glow& glow, const Transport& transport,
                                      const Surfels& surfels, std::span<const float> shares)
{
    std::vector<glm::vec3> irradiance = openIrradiance(glow, surfels);
    const std::vector<glm::vec4> met = metByRays(glow, transport, surfels);
    std::vector<float> noise(surfels.count());
    const SightLists& lists = transport.ofFronts;
    forEachChunk(surfels.count(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            float sum = 0.0f;
            for (const uint32_t n : surfels.neighborsOf(s)) sum += met[n].w / kPi;
            const float filled = sum / static_cast<float>(surfels.neighborsOf(s).size());
            const float near = ramp(kFar, kNear, filled);
            const auto rays = static_cast<float>(lists.first[s + 1] - lists.first[s]);
            const glm::vec3 byRays(met[s]);
            const float hits = std::max(filled * rays, 1.0f);
            noise[s] = near * luminance(byRays) * std::sqrt((1.0f - filled) / hits);
            irradiance[s] = glm::mix(shares[s] * irradiance[s], byRays, near);
        }
    });
    return withoutNoise(surfels, irradiance, noise);
}

} // namespace relamp
