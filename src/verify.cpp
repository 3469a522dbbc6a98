#include "relamp/verify.h"

#include "albedo/closed_loop.h"
#include "fit/correction_map.h"
#include "fit/light_correction.h"
#include "output/correction_file.h"
#include "output/fixtures_file.h"
#include "output/result_folder.h"
#include "shading/enclosed_texels.h"
#include "solve/by_pathtrace.h"
#include "solve/find_room.h"

namespace relamp
{
Verification verify(const std::filesystem::path& folder, const VerifyOptions& options,
                    Progress& progress)
{
    FormerRun run = readFormerRun(folder);
    run.scan.allowOutside = options.allowOutside;
    Verification result;
    result.scanFile = findScan(folder, run, options.scan);
    const Scan scan = scanOf(folder, run, result.scanFile, progress);
    const std::vector<Image> albedo = readAlbedo(folder, scan);
    DelightOptions asThen{.gather = run.gather};
    asThen.lights = readLights(folder / "lights.json", result.warnings);
    asThen.lights->tempering = {}; // of a shading, and here is none
    asThen.fixtures = readFixtureMaps(folder, scan.pages.size());
    for (size_t i = 0; i < asThen.lights->fixtures.size(); ++i)
        result.fixtures.push_back(asThen.lights->nameOf(i));

    const RayScene scene(scan);
    Texels texels = rasterizeAtlas(scan, progress, surfelsOf(run.gather));
    separateEnclosed(texels, scene, progress);
    const std::vector<float> lit =
        correctionBy(readCorrection(folder, scan.pages.size()), texels, folder);
    const FoundRoom found = findRoom(texels, scene, asThen, progress);
    result.warnings.insert(result.warnings.end(), found.warnings.begin(), found.warnings.end());
    const TracedRoom room =
        tracedRoomOf(texels, found, reflectanceBy(meanAlbedo(texels, found.radiance, albedo), lit));
    const auto places = renderAgain(texels, PathTracer(texels, scene, room), {albedo, lit},
                                    found.linearization, options, progress);
    compare(places, result);
    return result;
}

} // namespace relamp
