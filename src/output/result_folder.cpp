#include "output/result_folder.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr size_t kLargestReport = size_t{16} << 20; // bytes

std::vector<glm::vec3> placesFrom(const json& list)
{
    std::vector<glm::vec3> places;
    for (const json& place : list)
        places.emplace_back(place.at(0).get<float>(), place.at(1).get<float>(),
                            place.at(2).get<float>());
    return places;
}

Transfer transferNamed(const std::string& name)
{
    return name == "srgb"     ? Transfer::srgb
           : name == "linear" ? Transfer::linear
                              : Transfer::automatic;
}

FormerRun runFrom(const json& report)
{
    const json& scan = report.at("scan");
    const json& options = report.at("options");
    FormerRun run;
    run.scanFile = scan.at("file").get<std::string>();
    run.triangles = scan.at("triangles").get<size_t>();
    run.scan.up = scan.at("up") == "z" ? UpAxis::z : UpAxis::y;
    run.scan.scale = scan.at("scale").get<double>();
    run.scan.transfer = transferNamed(scan.at("transfer").get<std::string>());
    run.scan.longestSide = std::max(scan.value("longestSide", 0), 0);
    run.scan.skipMeshes = scan.at("skippedMeshes").get<std::vector<std::string>>();
    // Lamps are found on surfels as they were then, and so are the same.
    if (options.value("quality", "standard") == "draft") run.gather.quality = Quality::draft;
    run.gather.rays = options.value("rays", run.gather.rays);
    run.gather.lights = placesFrom(options.value("lights", json::array()));
    run.gather.notLights = placesFrom(options.value("notLights", json::array()));
    return run;
}

} // namespace

std::string nameOfLayer(const char* layer, size_t page, size_t pages, const char* ending)
{
    return pages == 1 ? fmt::format("{}.{}", layer, ending)
                      : fmt::format("{}.{}.{}", layer, page, ending);
}

FormerRun readFormerRun(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / "report.json";
    if (!std::filesystem::exists(file))
        fail(ErrorCode::cannotRead, folder.string(),
             "holds no report.json; name a folder that relamp delight has written");
    const auto bytes = readFile(file, kLargestReport);
    const json report =
        parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
    try {
        return runFrom(report);
    } catch (const json::exception&) {
        malformed(file.string(), "does not say how the scan was read; let this version's relamp "
                                 "delight write the folder anew");
    }
}

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

std::vector<Image> readAlbedo(const std::filesystem::path& folder, const Scan& scan)
{
    std::vector<Image> pages;
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        const auto file = folder / nameOfLayer("albedo", p, scan.pages.size(), "exr");
        pages.push_back(readImage(file));
        const Image& wanted = scan.pages[p].image;
        if (pages[p].width != wanted.width || pages[p].height != wanted.height)
            fail(ErrorCode::sizeMismatch, file.string(),
                 fmt::format("is {} x {}, the scan's page is {} x {}; it belongs to another scan",
                             pages[p].width, pages[p].height, wanted.width, wanted.height));
    }
    return pages;
}

} // namespace relamp
