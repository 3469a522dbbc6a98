#include "base/fail.h"
#include "base/half.h"
#include "output/result_folder.h"
#include "relamp/relight.h"
#include "scan/texels.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace relamp
{
namespace
{

/// Pictures of a folder, or as a person names them, each of the size of its page.
std::vector<Image> imagesOf(const std::vector<std::filesystem::path>& files, const Scan& scan)
{
    if (files.size() != scan.pages.size())
        throw Error(
            ErrorCode::sizeMismatch,
            fmt::format("--albedo names {} pictures, the scan has {} textures; name one for each",
                        files.size(), scan.pages.size()));
    std::vector<Image> images;
    for (size_t p = 0; p < files.size(); ++p) {
        images.push_back(readImage(files[p]));
        const Image& wanted = scan.pages[p].image;
        if (images[p].width != wanted.width || images[p].height != wanted.height)
            fail(ErrorCode::sizeMismatch, files[p].string(),
                 fmt::format(
                     "is {} x {}, the scan's texture is {} x {}; an albedo has the layout of "
                     "the scan's texture",
                     images[p].width, images[p].height, wanted.width, wanted.height));
    }
    return images;
}

/// Confidence as delight wrote it; none where a page of it is gone.
std::vector<Image> readConfidence(const std::filesystem::path& folder, const Scan& scan)
{
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        files.push_back(folder / nameOfLayer("confidence", p, scan.pages.size(), "png"));
        if (!std::filesystem::exists(files.back(), ignored)) return {};
    }
    return imagesOf(files, scan);
}

DelitRoom roomOfFolder(const std::filesystem::path& folder, const DelitOptions& options,
                       Progress& progress)
{
    FormerRun run = readFormerRun(folder);
    run.scan.allowOutside = options.asScan.allowOutside;
    DelitRoom room;
    room.scan = scanOf(folder, run, options.scan.empty() ? run.scanFile : options.scan, progress);
    room.gather = run.gather;
    room.captured = readLights(folder / "lights.json", room.warnings);
    room.transport = folder / "transport.bin";
    if (options.albedo.empty()) {
        room.albedo = readAlbedo(folder, room.scan);
        room.confidence = readConfidence(folder, room.scan);
    }
    return room;
}

bool isTinted(const Scan& scan, size_t page)
{
    return std::ranges::any_of(scan.meshes, [page](const Mesh& mesh) {
        return mesh.page == static_cast<int>(page) &&
               (mesh.factor != glm::vec3(1.0f) || !mesh.colors.empty());
    });
}

/// The picture of a page times the colours that meshes have beside it.
Image paintedPage(const Texels& texels, size_t page)
{
    const Image& picture = texels.scan->pages[page].image;
    Image painted = picture;
    painted.transfer = Transfer::linear;
    painted.encoded.clear();
    painted.half.resize(3 * picture.pixels());
    const auto put = [&](size_t pixel, glm::vec3 color) {
        for (int c = 0; c < 3; ++c)
            painted.half[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(color[c]);
    };
    const Radiance plain(picture);
    for (size_t pixel = 0; pixel < picture.pixels(); ++pixel) put(pixel, plain[pixel]);
    const TexelLoader loader(texels, page);
    forEachBlock(texels.pages[page], [&](size_t begin, size_t count) {
        TexelBlock block;
        loader.loadRadiance(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            put(texels.pages[page].pixel[begin + i], {block.r[i], block.g[i], block.b[i]});
    });
    return painted;
}

/// The base colour of a scan that no light is in.
std::vector<Image> paintOf(const Scan& scan, Progress& progress)
{
    std::vector<Image> albedo;
    std::optional<Texels> texels;
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        if (isTinted(scan, p) && !texels) texels = rasterizeAtlas(scan, progress);
        albedo.push_back(isTinted(scan, p) ? paintedPage(*texels, p) : scan.pages[p].image);
    }
    return albedo;
}

} // namespace

DelitRoom readDelitRoom(const std::filesystem::path& folderOrScan, const DelitOptions& options,
                        Progress& progress)
{
    std::error_code ignored;
    const bool isFolder = std::filesystem::is_directory(folderOrScan, ignored);
    DelitRoom room;
    if (isFolder) {
        room = roomOfFolder(folderOrScan, options, progress);
    } else {
        room.scan = readScan(folderOrScan, options.asScan, progress);
        room.isLit = false;
        if (options.albedo.empty()) room.albedo = paintOf(room.scan, progress);
    }
    if (!options.albedo.empty()) room.albedo = imagesOf(options.albedo, room.scan);
    room.warnings.insert(room.warnings.end(), room.scan.warnings.begin(), room.scan.warnings.end());
    return room;
}

} // namespace relamp
