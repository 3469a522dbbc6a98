#include "base/fail.h"
#include "base/half.h"
#include "lights/json_item.h"
#include "lights/lights_from.h"
#include "output/correction_file.h"
#include "output/fixtures_file.h"
#include "output/folder_record.h"
#include "output/result_folder.h"
#include "relamp/names.h"
#include "relamp/relight.h"
#include "scan/gltf_read.h"
#include "scan/gltf_write.h"
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
    const FormerRun run = readFormerRun(folder);
    DelitRoom room;
    room.scanFile = run.scanFile;
    room.folder = folder;
    room.scan = std::make_shared<const Scan>(roomOf(folder, run, progress));
    room.isLit = false;
    room.gather = run.gather;
    room.captured = readLights(folder / "lights.json", room.warnings);
    room.fixtures = readFixtureMaps(folder, room.scan->pages.size());
    room.correction = readCorrection(folder, room.scan->pages.size());
    room.transport = folder / "transport.bin";
    if (options.albedo.empty()) {
        room.albedo = readAlbedo(folder, *room.scan);
        room.confidence = readConfidence(folder, *room.scan);
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
    std::vector<uint16_t> half(3 * picture.pixels());
    const auto put = [&](size_t pixel, glm::vec3 color) {
        for (int c = 0; c < 3; ++c)
            half[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(color[c]);
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
    painted.rgb = std::move(half);
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

/// What a GLB says of itself, where relamp has written it; else an empty object.
nlohmann::json signatureOf(const Scan& scan)
{
    if (!scan.gltf) return nlohmann::json::object();
    const auto place = nlohmann::json::json_pointer("/asset/extras") / kSignature;
    nlohmann::json signature = scan.gltf->document.value(place, nlohmann::json::object());
    return signature.is_object() ? signature : nlohmann::json::object();
}

/// The lights of the room that a GLB tells of. They stand where the scan stood, read as then.
Lights lightsOf(const nlohmann::json& signature, const std::filesystem::path& file,
                const Scan& scan, std::vector<std::string>& warnings)
{
    if (!signature.contains("lights")) return {};
    const std::string up = nameOf(scan.options.up);
    if (signature.value("up", nlohmann::json(up)) != up ||
        signature.value("scale", nlohmann::json(scan.options.scale)) != scan.options.scale) {
        warnings.push_back(fmt::format("{}: was made with --up {} --scale {}; say so again, or its "
                                       "own lights are left out",
                                       file.string(), printable(signature["up"]),
                                       printable(signature["scale"])));
        return {};
    }
    const std::string what = fmt::format("{}: its lights", file.string());
    return lightsFrom(JsonDocument(what, signature["lights"].dump(), kLightsFormat), warnings);
}

DelitRoom roomOfScan(const std::filesystem::path& file, const DelitOptions& options,
                     Progress& progress)
{
    DelitRoom room;
    room.scanFile = file;
    room.scan = std::make_shared<const Scan>(readScan(file, options.asScan, progress));
    room.isLit = false;
    const nlohmann::json signature = signatureOf(*room.scan);
    const bool isAlbedo =
        options.textureIsAlbedo || signature.value("textures", nlohmann::json()) == "albedo";
    if (options.albedo.empty() && !isAlbedo)
        fail(
            ErrorCode::unsupported, file.string(),
            fmt::format("its texture has the light of the room in it, as scans have. Take that out "
                        "first, relamp delight {0} -o {1}, and relight {1}; or say "
                        "--texture-is-albedo if no light was ever baked into it",
                        file.string(), room.scan->name));
    room.captured = lightsOf(signature, file, *room.scan, room.warnings);
    if (options.albedo.empty()) room.albedo = paintOf(*room.scan, progress);
    return room;
}

/// The folder whose result a GLB is, as long as nobody changed it; empty for any other file.
std::filesystem::path folderOfResult(const std::filesystem::path& file)
{
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const FolderRecord record = FolderRecord::read(folder, kReport);
    const bool isIts = file.extension() == ".glb" && record.isAsWritten(folder, file.filename());
    return isIts ? folder : std::filesystem::path();
}

/// A GLB in the folder of its result stands for the folder.
DelitRoom roomOfFile(const std::filesystem::path& file, const DelitOptions& options,
                     Progress& progress)
{
    const std::filesystem::path folder = folderOfResult(file);
    return folder.empty() ? roomOfScan(file, options, progress)
                          : roomOfFolder(folder, options, progress);
}

/// RGB of a page, as linear half floats.
Image linearImage(const PageLayers& layers, std::vector<uint16_t> rgb)
{
    Image image{.width = layers.width, .height = layers.height, .transfer = Transfer::linear};
    image.clipsAtWhite = false;
    image.rgb = std::move(rgb);
    return image;
}

Image greyImage(const PageLayers& layers)
{
    Image image{.width = layers.width, .height = layers.height};
    std::vector<uint8_t> rgb(3 * image.pixels());
    for (size_t i = 0; i < layers.confidence.size(); ++i)
        std::fill_n(&rgb[3 * i], 3, layers.confidence[i]);
    image.rgb = std::move(rgb);
    return image;
}

} // namespace

DelitRoom delitRoomOf(const Decomposition& decomposition, Progress& progress)
{
    DelitRoom room{.scan = decomposition.scan(), .scanFile = decomposition.scan()->file};
    for (size_t p = 0; p < room.scan->pages.size(); ++p) {
        PageLayers layers = decomposition.layers(p, progress);
        room.confidence.push_back(greyImage(layers));
        room.albedo.push_back(linearImage(layers, std::move(layers.albedo)));
        room.fixtures.push_back(decomposition.fixtures(p));
        room.correction.push_back(decomposition.correction(p));
    }
    room.captured = decomposition.lights();
    room.gather = decomposition.optionsInForce().gather;
    room.warnings = room.scan->warnings;
    return room;
}

DelitRoom readDelitRoom(const std::filesystem::path& folderOrScan, const DelitOptions& options,
                        Progress& progress)
{
    std::error_code ignored;
    DelitRoom room = std::filesystem::is_directory(folderOrScan, ignored)
                         ? roomOfFolder(folderOrScan, options, progress)
                         : roomOfFile(folderOrScan, options, progress);
    if (!options.albedo.empty()) room.albedo = imagesOf(options.albedo, *room.scan);
    room.warnings.insert(room.warnings.end(), room.scan->warnings.begin(),
                         room.scan->warnings.end());
    return room;
}

std::vector<Image> readScanned(const DelitRoom& room, const DelitOptions& options,
                               Progress& progress)
{
    std::optional<Scan> scan;
    if (!room.folder.empty()) {
        FormerRun run = readFormerRun(room.folder);
        run.scan.allowOutside = options.asScan.allowOutside;
        scan = scanOf(room.folder, run, findScan(room.folder, run, options.scan), progress);
    }
    std::vector<Image> pictures;
    for (const Page& page : (scan ? *scan : *room.scan).pages) pictures.push_back(page.image);
    return pictures;
}

} // namespace relamp
