#include "base/fail.h"
#include "base/file.h"
#include "base/half.h"
#include "base/parallel.h"
#include "image/transfer.h"
#include "image/view_transform.h"
#include "image/write_image.h"
#include "output/result_folder.h"
#include "output/staged_file.h"
#include "relamp/relight.h"
#include "scan/gltf_write.h"

#include <memory>
#include <vector>

namespace relamp
{
namespace
{

std::filesystem::path fileOfPage(const std::filesystem::path& file, size_t page, size_t pages)
{
    return file.parent_path() / nameOfLayer(file.stem().c_str(), page, pages, "exr");
}

void writeTextures(const Relighter& relighter, const std::filesystem::path& file,
                   Progress& progress)
{
    const size_t pages = relighter.room().scan->pages.size();
    std::vector<std::unique_ptr<StagedFile>> staged;
    for (size_t page = 0; page < pages; ++page)
        staged.push_back(std::make_unique<StagedFile>(fileOfPage(file, page, pages), progress));
    for (size_t page = 0; page < pages; ++page) {
        const Image radiance = relighter.radiance(page, progress);
        const Progress::Stage stage(progress, "write");
        writeExr(staged[page]->path(), radiance.half(), {radiance.width, radiance.height});
    }
    progress.check();
    for (const auto& one : staged) one->commit();
}

/// What a screen shows of linear half floats, sRGB.
std::vector<uint8_t> shownBytes(const std::vector<uint16_t>& half, const ViewTransform& view)
{
    std::vector<uint8_t> bytes(half.size());
    forEachChunk(half.size() / 3, size_t{1} << 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 shown =
                view.displayed({floatFromHalf(half[3 * i]), floatFromHalf(half[3 * i + 1]),
                                floatFromHalf(half[3 * i + 2])});
            for (int c = 0; c < 3; ++c)
                bytes[3 * i + static_cast<size_t>(c)] = srgbByteFromLinear(shown[c]);
        }
    });
    return bytes;
}

std::vector<float> shownFloats(const std::vector<uint16_t>& half, const ViewTransform& view)
{
    std::vector<float> floats(half.size());
    for (size_t i = 0; i + 2 < half.size(); i += 3) {
        const glm::vec3 shown = view.displayed(
            {floatFromHalf(half[i]), floatFromHalf(half[i + 1]), floatFromHalf(half[i + 2])});
        for (int c = 0; c < 3; ++c) floats[i + static_cast<size_t>(c)] = shown[c];
    }
    return floats;
}

RelitPage bakedPage(const Page& page, const Image& radiance, const ViewTransform& view)
{
    RelitPage baked;
    if (page.ofVertices) {
        baked.vertexAlbedo = shownFloats(radiance.half(), view);
        return baked;
    }
    const Size size{radiance.width, radiance.height};
    const std::vector<uint8_t> rgb = shownBytes(radiance.half(), view);
    if (page.image.wasJpeg && radiance.alpha.empty())
        baked.albedo = {encodeJpeg(rgb, size), "image/jpeg"};
    else if (radiance.alpha.empty())
        baked.albedo = {encodePng(rgb, size, 3), "image/png"};
    else
        baked.albedo = {encodePng(withAlpha(rgb, radiance.alpha), size, 4), "image/png"};
    return baked;
}

void writeBakedGlb(const Relighter& relighter, const std::filesystem::path& file,
                   const ViewOptions& options, Progress& progress)
{
    const Scan& scan = *relighter.room().scan;
    const ViewTransform view(options);
    StagedFile staged(file, progress);
    std::vector<RelitPage> pages;
    for (size_t page = 0; page < scan.pages.size(); ++page)
        pages.push_back(bakedPage(scan.pages[page], relighter.radiance(page, progress), view));
    const Progress::Stage stage(progress, "write");
    writeFile(staged.path(), writeUnlitGlb(scan, pages));
    progress.check();
    staged.commit();
}

} // namespace

void writeBaked(const Relighter& relighter, const std::filesystem::path& file,
                const ViewOptions& view, Progress& progress)
{
    const std::string ending = file.extension().string();
    if (ending == ".exr") return writeTextures(relighter, file, progress);
    if (ending == ".glb") return writeBakedGlb(relighter, file, view, progress);
    fail(ErrorCode::cannotWrite, file.string(),
         "light is baked into textures, .exr, or a model, .glb; end the name so");
}

} // namespace relamp
