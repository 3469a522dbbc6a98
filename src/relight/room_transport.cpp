#include "relight/room_transport.h"

#include "fit/given_lamps.h"
#include "relamp/error.h"
#include "relight/transport_file.h"
#include "shading/hit_lists.h"
#include "solve/found_room.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfScan = 6'000'000;
constexpr size_t kFewestRays = 64;
constexpr size_t kMostRays = 256;

/// The burnt-out surface of each captured fixture, as delight finds it; of one that the scan does
/// not show, a disc or a ball.
std::vector<std::vector<ClippedPatch>> surfacesOfFixtures(const DelitRoom& room,
                                                          const Texels& texels,
                                                          const RayScene& scene, Progress& progress)
{
    if (room.captured.fixtures.empty()) return {};
    FoundLamps found;
    std::vector<Candidate> candidates;
    if (room.isLit) {
        const DelightOptions asThen{.gather = room.gather};
        FoundRoom then = findRoom(texels, scene, asThen, progress);
        candidates = findCandidates(texels, then.radiance);
        found = std::move(then.found);
    }
    std::vector<std::vector<ClippedPatch>> surfaces;
    for (Fixture fixture : room.captured.fixtures) {
        fixture.radiance = glm::vec3(1.0f); // also of one that was off
        Lights one;
        one.fixtures.push_back(fixture);
        surfaces.push_back(asGiven(one, found, candidates).lamps.at(0).patches);
    }
    return surfaces;
}

} // namespace

size_t raysOf(const RelightOptions& options, size_t surfels)
{
    if (options.rays > 0) return static_cast<size_t>(options.rays);
    return std::clamp(kRaysOfScan / std::max<size_t>(surfels, 1), kFewestRays, kMostRays);
}

Transport transportOfRoom(const DelitRoom& room, const SurfaceOfRoom& surface,
                          const RelightOptions& options, std::vector<std::string>& warnings,
                          Progress& progress)
{
    const Texels& texels = surface.texels;
    const size_t rays = raysOf(options, texels.surfels.count());
    const uint64_t key =
        options.transport.empty() ? 0 : keyOfTransport(texels, room.captured.fixtures, rays);
    if (!options.transport.empty())
        if (auto kept = loadTransport(options.transport, key, texels);
            kept && kept->fixtures.size() == room.captured.fixtures.size())
            return std::move(*kept);

    std::vector<std::vector<ClippedPatch>> fixtures =
        surfacesOfFixtures(room, texels, surface.scene, progress);
    Transport transport =
        transportOf(texels, castHitLists(texels, surface.scene, surface.radiance, rays, progress));
    transport.fixtures = std::move(fixtures);
    if (options.transport.empty()) return transport;
    const Progress::Stage stage(progress, "write");
    try {
        saveTransport(options.transport, key, transport);
    } catch (const Error& error) {
        warnings.push_back(fmt::format(
            "{}; what the rays met could not be kept and will be looked for again", error.what()));
    }
    return transport;
}

} // namespace relamp
