#include "output/result_folder.h"

#include "base/fail.h"
#include "lights/json_document.h"
#include "relamp/names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace relamp
{
namespace
{

/// A way that begins at `folder` as it is from here. Both may lead through links.
std::filesystem::path fromHere(const std::filesystem::path& folder, const std::string& way)
{
    std::error_code failure;
    const auto place = std::filesystem::weakly_canonical(folder, failure) / way;
    const auto here = std::filesystem::proximate(place, failure);
    return failure || here.empty() ? place : here;
}

FormerRun runFrom(const JsonItem& report, const std::filesystem::path& folder)
{
    constexpr std::int64_t kMostTriangles = std::int64_t{1} << 40;
    constexpr int kMostRays = 1024;
    constexpr std::int64_t kMostSeed = std::numeric_limits<uint32_t>::max();
    constexpr int kLongestPageSide = 1 << 20;

    const JsonItem scan = report.objectAt("scan");
    const JsonItem options = report.objectAt("options");
    FormerRun run;
    const auto mark = markFrom(*report.find("scan"));
    if (!mark)
        malformed((folder / kReport).string(),
                  "does not tell which file the scan was, as relamp 0.1 did not");
    run.scanMark = *mark;
    run.scanFile = fromHere(folder, scan.textAt("file"));
    run.triangles = static_cast<size_t>(scan.whole("triangles", 0, kMostTriangles, 0));
    run.scan.up = named<UpAxis>(scan.textAt("up")).value_or(UpAxis::y);
    run.scan.scale = scan.numberAt("scale", 1e-6, 1e6);
    run.scan.transfer = named<Transfer>(scan.textAt("transfer")).value_or(Transfer::automatic);
    run.scan.longestSide = static_cast<int>(scan.whole("longestSide", 0, kLongestPageSide, 0));
    run.scan.skipMeshes = scan.texts("skippedMeshes");
    run.scan.allowOverlap = scan.flag("allowOverlap", false);
    run.isGltf = scan.flag("gltf", false);
    // Lamps are found on surfels as they were then, and so are the same.
    if (named<Quality>(options.text("quality", "")) == Quality::draft)
        run.gather.quality = Quality::draft;
    run.gather.rays = static_cast<int>(options.whole("rays", 0, kMostRays, run.gather.rays));
    run.gather.seed = static_cast<uint32_t>(options.whole("raySeed", 0, kMostSeed, 1));
    run.gather.lights = options.vectors("lights");
    run.gather.notLights = options.vectors("notLights");
    run.gather.sun = options.flag("sun", true);
    return run;
}

constexpr std::array<std::pair<const char*, const char*>, 9> kLayers{{{"albedo", "png"},
                                                                      {"albedo", "exr"},
                                                                      {"shading", "exr"},
                                                                      {"direct", "exr"},
                                                                      {"indirect", "exr"},
                                                                      {"confidence", "png"},
                                                                      {"reasons", "png"},
                                                                      {"fixtures", "png"},
                                                                      {"correction", "png"}}};

/// Whether `name` is nameOfLayer(layer, page, pages, ending) for some page.
bool isOfLayer(std::string_view name, std::string_view layer, std::string_view ending)
{
    if (!name.starts_with(layer) || !name.ends_with(ending)) return false;
    name.remove_prefix(layer.size());
    name.remove_suffix(ending.size());
    if (name == ".") return true;
    return name.size() > 2 && name.front() == '.' && name.back() == '.' &&
           std::all_of(name.begin() + 1, name.end() - 1,
                       [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

bool isOfResult(const std::string& name, const std::string& scan, const ResultOptions& options)
{
    if (options.usd && (name == scan + ".usda" || isOfLayer(name, "emission", "exr"))) return true;
    if (name == kReport || name == "lights.json" || name == "preview.png" || name == scan + ".glb")
        return true;
    return std::ranges::any_of(
        kLayers, [&](const auto& layer) { return isOfLayer(name, layer.first, layer.second); });
}

std::string nameOfLayer(const char* layer, size_t page, size_t pages, const char* ending)
{
    return pages == 1 ? fmt::format("{}.{}", layer, ending)
                      : fmt::format("{}.{}.{}", layer, page, ending);
}

FormerRun readFormerRun(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / kReport;
    if (!std::filesystem::exists(file))
        fail(ErrorCode::cannotRead, folder.string(),
             "holds no report.json; name a folder that relamp delight has written");
    try {
        const JsonDocument document(file, nullptr);
        return runFrom(document.top(), folder);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}.\nIt was edited, or is of another version; let "
                                              "relamp delight write the folder anew, with --force",
                                              error.what()));
    }
}

std::filesystem::path findScan(const std::filesystem::path& folder, const FormerRun& run,
                               const std::filesystem::path& now)
{
    const std::filesystem::path& file = now.empty() ? run.scanFile : now;
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        fail(ErrorCode::cannotRead, file.string(),
             fmt::format("is not there, and {} was made from it; say where the scan is now with "
                         "--scan FILE",
                         folder.string()));
    const FileMark mark = markOf(file);
    if (mark == run.scanMark) return file;
    const bool isOwn = std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(),
                                                   folder, ignored) &&
                       FolderRecord::read(folder, kReport).lists(file.filename());
    fail(ErrorCode::sizeMismatch, file.string(),
         fmt::format("is {} ({}); {} was made from a file of {}. Name that one with --scan FILE",
                     isOwn ? "what relamp wrote, not the scan" : "not the scan as it was",
                     inWords(mark), folder.string(), inWords(run.scanMark)));
}

Scan scanOf(const std::filesystem::path& folder, const FormerRun& run,
            const std::filesystem::path& file, Progress& progress)
{
    Scan scan = readScan(file, run.scan, progress);
    if (scan.triangleCount() != run.triangles)
        fail(ErrorCode::sizeMismatch, file.string(),
             fmt::format("has {} triangles, but {} was made from a scan of {}; name that one with "
                         "--scan FILE",
                         scan.triangleCount(), folder.string(), run.triangles));
    return scan;
}

Scan roomOf(const std::filesystem::path& folder, const FormerRun& run, Progress& progress)
{
    const FolderRecord record = FolderRecord::read(folder, kReport);
    const std::vector<std::string> names = record.names();
    const auto glb =
        std::ranges::find_if(names, [](const std::string& name) { return name.ends_with(".glb"); });
    const std::filesystem::path file = folder / (glb == names.end() ? "scan.glb" : *glb);
    if (glb == names.end() || !record.isAsWritten(folder, *glb))
        fail(ErrorCode::cannotRead, file.string(),
             "is not there as relamp delight wrote it, and the room of this folder is read from "
             "it; let relamp delight write the folder anew, with --force");
    ScanOptions options{.allowOverlap = run.scan.allowOverlap};
    if (run.isGltf) { // else it was written in the world's frame, without what was left out
        options.up = run.scan.up;
        options.scale = run.scan.scale;
        options.skipMeshes = run.scan.skipMeshes;
    }
    Scan room = readScan(file, options, progress);
    if (room.triangleCount() != run.triangles)
        fail(ErrorCode::sizeMismatch, file.string(),
             fmt::format("has {} triangles, and its report tells of {}; let relamp delight write "
                         "the folder anew, with --force",
                         room.triangleCount(), run.triangles));
    return room;
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
