#include "relamp/verify.h"

#include "albedo/closed_loop.h"
#include "base/fail.h"
#include "output/result_folder.h"
#include "solve/by_pathtrace.h"
#include "solve/found_room.h"

#include <fmt/format.h>

namespace relamp
{
namespace
{

Scan scanOf(const std::filesystem::path& folder, const FormerRun& run,
            const std::filesystem::path& file, Progress& progress)
{
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        fail(ErrorCode::cannotRead, file.string(),
             fmt::format("is not there, and {} was made from it; say where the scan is now with "
                         "--scan FILE",
                         folder.string()));
    Scan scan = readScan(file, run.scan, progress);
    if (scan.triangleCount() != run.triangles)
        fail(ErrorCode::sizeMismatch, file.string(),
             fmt::format("has {} triangles, but {} was made from a scan of {}; name that one with "
                         "--scan FILE",
                         scan.triangleCount(), folder.string(), run.triangles));
    return scan;
}

} // namespace

Verification verify(const std::filesystem::path& folder, const VerifyOptions& options,
                    Progress& progress)
{
    const FormerRun run = readFormerRun(folder);
    Verification result;
    result.scanFile = options.scan.empty() ? run.scanFile : options.scan;
    const Scan scan = scanOf(folder, run, result.scanFile, progress);
    const std::vector<Image> albedo = readAlbedo(folder, scan);
    DelightOptions asThen{.gather = run.gather};
    asThen.lights = readLights(folder / "lights.json", result.warnings);

    const RayScene scene(scan);
    const Texels texels = rasterizeAtlas(scan, progress, surfelsOf(run.gather.quality));
    const FoundRoom found = findRoom(texels, scene, asThen, progress);
    if (found.sun) result.warnings.emplace_back(kSunIsNotTraced);
    const TracedRoom room = tracedRoomOf(texels, found, meanAlbedo(texels, found.radiance, albedo));
    const auto places =
        renderAgain(texels, PathTracer(texels, scene, room), albedo, options, progress);
    compare(places, result);
    return result;
}

} // namespace relamp
