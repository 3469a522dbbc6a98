#include "output/result_folder.h"

#include "base/fail.h"
#include "lights/json_document.h"

namespace relamp
{
namespace
{

Transfer transferNamed(const std::string& name)
{
    return name == "srgb"     ? Transfer::srgb
           : name == "linear" ? Transfer::linear
                              : Transfer::automatic;
}

FormerRun runFrom(const JsonItem& report)
{
    constexpr std::int64_t kMostTriangles = std::int64_t{1} << 40;
    constexpr int kMostRays = 1024;
    constexpr int kLongestPageSide = 1 << 20;

    const JsonItem scan = report.objectAt("scan");
    const JsonItem options = report.objectAt("options");
    FormerRun run;
    run.scanFile = scan.textAt("file");
    run.triangles = static_cast<size_t>(scan.whole("triangles", 0, kMostTriangles, 0));
    run.scan.up = scan.textAt("up") == "z" ? UpAxis::z : UpAxis::y;
    run.scan.scale = scan.numberAt("scale", 1e-6, 1e6);
    run.scan.transfer = transferNamed(scan.textAt("transfer"));
    run.scan.longestSide = static_cast<int>(scan.whole("longestSide", 0, kLongestPageSide, 0));
    run.scan.skipMeshes = scan.texts("skippedMeshes");
    // Lamps are found on surfels as they were then, and so are the same.
    if (options.text("quality", "standard") == "draft") run.gather.quality = Quality::draft;
    run.gather.rays = static_cast<int>(options.whole("rays", 0, kMostRays, run.gather.rays));
    run.gather.lights = options.vectors("lights");
    run.gather.notLights = options.vectors("notLights");
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
    try {
        const JsonDocument document(file, nullptr);
        return runFrom(document.top());
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}.\nIt was edited, or is of another version; let "
                                              "relamp delight write the folder anew",
                                              error.what()));
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
            fail(
                ErrorCode::sizeMismatch, file.string(),
                fmt::format("is {} x {}, the scan's texture is {} x {}; it belongs to another scan",
                            pages[p].width, pages[p].height, wanted.width, wanted.height));
    }
    return pages;
}

} // namespace relamp
