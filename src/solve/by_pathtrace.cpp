#include "solve/by_pathtrace.h"

#include "albedo/gather_closure.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "solve/albedo_scale.h"
#include "solve/cross_validation.h"
#include "solve/find_room.h"
#include "solve/proof.h"
#include "solve/room_solution.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace relamp
{
namespace
{

constexpr int kRounds = 3;          // of albedo and light; each takes the error times an albedo
constexpr size_t kOrigins = 4;      // texels of a surfel that paths start from
constexpr uint64_t kOfTexels = ~0u; // sequence of random numbers; those of surfels are the rounds

/// Irradiance on the fronts of surfels. Bounce light is the mean over the surfels around: it
/// changes slowly, and a divisor's noise does not average away.
std::vector<glm::vec3> irradianceOf(const Texels& texels, std::span<const TracedShading> shading)
{
    const Surfels& surfels = texels.surfels;
    std::vector<glm::vec3> irradiance(surfels.count());
    forEachChunk(irradiance.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            glm::vec3 indirect(0.0f);
            float count = 0.0f;
            for (const uint32_t n : surfels.neighborsOf(s)) {
                if (!surfels.areBeside(s, n)) continue;
                indirect += shading[n].indirect;
                count += 1.0f;
            }
            irradiance[s] = kPi * (shading[s].direct + indirect / count); // itself is around
        }
    });
    return irradiance;
}

std::vector<TracedShading> shadeSurfels(const Texels& texels, const PathTracer& tracer,
                                        const PathtraceOptions& options, int round,
                                        Progress::Stage& stage)
{
    const SurfelSites sites(texels);
    const size_t paths = (static_cast<size_t>(options.samples) + kOrigins - 1) / kOrigins;
    std::vector<TracedShading> shading(texels.surfels.count());
    forEachChunk(shading.size(), 64, [&](size_t begin, size_t end) {
        for (auto s = static_cast<uint32_t>(begin); s < end; ++s)
            for (uint32_t k = 0; k < kOrigins; ++k) {
                const Random random(options.seed, static_cast<uint64_t>(round), kOrigins * s + k);
                const TracedShading one = tracer.shade(sites.at(s, k), paths, random);
                shading[s].direct += one.direct / static_cast<float>(kOrigins);
                shading[s].indirect += one.indirect / static_cast<float>(kOrigins);
            }
        stage.advance(end - begin);
    });
    return shading;
}

struct Settled
{
    Closure closure;
    std::vector<glm::vec3> irradiance; // on the fronts of surfels
};

/// Albedo and light in turn until they agree; closes the loop on the way.
Settled settle(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance,
               const PathtraceOptions& options, TracedRoom& room, Progress& progress)
{
    Progress::Stage stage(progress, "paths", kRounds * texels.surfels.count());
    Settled settled;
    for (int round = 0; round < kRounds; ++round) {
        const PathTracer tracer(texels, scene, room);
        settled.irradiance =
            irradianceOf(texels, shadeSurfels(texels, tracer, options, round, stage));
        const std::vector<glm::vec3>& irradiance = settled.irradiance;
        std::vector<glm::vec3> again(irradiance.size());
        for (size_t s = 0; s < again.size(); ++s) again[s] = room.albedo[s] * irradiance[s] / kPi;
        settled.closure = closureOf(radiance, again);
        room.albedo = albedoOf(texels, radiance, irradiance);
    }
    return settled;
}

} // namespace

TexelShading shadingOf(const Texels& texels, const RayScene& scene,
                       std::shared_ptr<const TracedRoom> room, const PathtraceOptions& options)
{
    return [&texels, &scene, room = std::move(room),
            options](size_t page, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        const PathTracer tracer(texels, scene, *room);
        for (size_t i = 0; i < block.count; ++i) {
            const Random random(options.seed, kOfTexels + page, begin + i);
            const TracedShading shading = tracer.shade(
                {{block.x[i], block.y[i], block.z[i]}, {block.nx[i], block.ny[i], block.nz[i]}},
                static_cast<size_t>(options.samples), random);
            out.direct.r[i] = shading.direct.r;
            out.direct.g[i] = shading.direct.g;
            out.direct.b[i] = shading.direct.b;
            out.indirect.r[i] = shading.indirect.r;
            out.indirect.g[i] = shading.indirect.g;
            out.indirect.b[i] = shading.indirect.b;
        }
    };
}

TracedRoom tracedRoomOf(const Texels& texels, const FoundRoom& room, std::vector<glm::vec3> albedo)
{
    std::vector<Shiner> shiners;
    std::vector<glm::vec3> emission(texels.surfels.count(), glm::vec3(0.0f));
    for (size_t l = 0; l < room.found.lamps.size(); ++l) {
        const Shiner& lamp =
            shiners.emplace_back(Shiner{room.found.lamps[l].patches, room.found.powers.lamps[l]});
        for (const ClippedPatch& patch : lamp.patches)
            if (patch.surfel != Surfels::kNone) emission[patch.surfel] = lamp.radiance;
    }
    TracedRoom traced{.albedo = std::move(albedo),
                      .shines = shinesOf(room, room.found.powers),
                      .emission = std::move(emission),
                      .isClipped = room.radiance.isClipped,
                      .lamps = LampSurface(lampTexels(texels, room.radiance, shiners)),
                      .ambient = room.found.powers.outside.even(),
                      .outside = {},
                      .unseenLights = {}};
    if (const auto& sun = room.found.sun)
        traced.unseenLights =
            [outside = sun->outside, disc = AreaLight(sunDisc(sun->sun, *texels.scan)),
             radiance = room.found.powers.lamps.back()](const TexelSite& place, Random& random) {
                const AreaSample one =
                    sampleAreaLight(outside, disc, place.position, place.normal, 1, random.next());
                return one.visible / kPi * radiance;
            };
    return traced;
}

Solution solveByPathtrace(const Texels& texels, const RayScene& scene,
                          const DelightOptions& options, Progress& progress)
{
    FoundRoom found = findRoom(texels, scene, options, progress);
    const auto room = std::make_shared<TracedRoom>(
        tracedRoomOf(texels, found, found.sides.albedo)); // a good start
    Settled settled = settle(texels, scene, found.radiance, options.pathtrace, *room, progress);
    const SurfelLighting lighting{std::move(settled.irradiance), {}};
    const Witnesses witnesses = witnessesOf(texels, scene, found);
    temper(texels, witnesses, lighting.irradiance, found);
    scaleAlbedo(lighting.irradiance, crossValidate(witnesses, lighting.irradiance, found.tempering),
                found);
    return solutionOf(texels,
                      {.found = found,
                       .witnesses = witnesses,
                       .lighting = lighting,
                       .shade = shadingOf(texels, scene, room, options.pathtrace)},
                      options, settled.closure);
}

} // namespace relamp
