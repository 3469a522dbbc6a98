#include "relight/room_transport.h"

#include "fit/given_lamps.h"
#include "lights/fixture_map.h"
#include "relamp/error.h"
#include "relight/transport_file.h"
#include "shading/hit_lists.h"

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

} // namespace

size_t raysOf(const RelightOptions& options, size_t surfels)
{
    if (options.rays > 0) return static_cast<size_t>(options.rays);
    return std::clamp(kRaysOfScan / std::max<size_t>(surfels, 1), kFewestRays, kMostRays);
}

std::vector<std::vector<ClippedPatch>> surfacesOfRoom(const DelitRoom& room,
                                                      const SurfaceOfRoom& surface,
                                                      std::vector<std::string>& warnings)
{
    KnownSurfaces known{surfacesBy(room.fixtures, surface.texels, surface.radiance), {}};
    if (room.isLit)
        known.burntOut = [&] { return findCandidates(surface.texels, surface.radiance); };
    std::vector<std::string> notes;
    std::vector<std::vector<ClippedPatch>> surfaces =
        surfacesOf(room.captured.fixtures, known, surface.texels, surface.scene, notes);
    // A room that knows nothing of its texels, as a GLB by itself, has no numbers to go by.
    if (!room.fixtures.empty()) warnings.insert(warnings.end(), notes.begin(), notes.end());
    return surfaces;
}

Transport transportOfRoom(const SurfaceOfRoom& surface, const RelightOptions& options,
                          std::vector<std::string>& warnings, Progress& progress)
{
    const Texels& texels = surface.texels;
    const size_t rays = raysOf(options, texels.surfels.count());
    const uint64_t key = options.transport.empty() ? 0 : keyOfTransport(texels, rays);
    if (!options.transport.empty())
        if (auto kept = loadTransport(options.transport, key, texels)) return std::move(*kept);

    Transport transport =
        transportOf(texels, castHitLists(texels, surface.scene, surface.radiance, rays, progress));
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
