#include "solving.h"

#include "parallel.h"

#include "inside/flattened.h"
#include "relamp/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace
{

constexpr int kDraftLength = 1024;          // pixels
constexpr size_t kTexelsAtOnce = 2'000'000; // that follow a slider without a draft

relamp::Image imageOf(const relamp::PageLayers& layers, std::vector<uint16_t> half)
{
    relamp::Image image;
    image.width = layers.width;
    image.height = layers.height;
    image.transfer = relamp::Transfer::linear;
    image.clipsAtWhite = false;
    image.rgb = std::move(half);
    return image;
}

relamp::Image greyOf(const relamp::PageLayers& layers)
{
    relamp::Image image;
    image.width = layers.width;
    image.height = layers.height;
    std::vector<uint8_t> rgb(3 * layers.confidence.size());
    for (size_t i = 0; i < layers.confidence.size(); ++i)
        std::fill_n(&rgb[3 * i], 3, layers.confidence[i]);
    image.rgb = std::move(rgb);
    return image;
}

/// Divides page after page, and keeps of each what is shown and what relighting needs.
Paint divide(const relamp::Decomposition& found, const PageShrinker& shrunk, size_t pages,
             Solved& solved, relamp::Progress& progress)
{
    Paint paint;
    for (size_t p = 0; p < pages; ++p) {
        relamp::PageLayers layers = found.layers(p, progress);
        const relamp::Image direct = imageOf(layers, std::move(layers.direct));
        const relamp::Image indirect = imageOf(layers, std::move(layers.indirect));
        paint.albedo.push_back(imageOf(layers, std::move(layers.albedo)));
        paint.confidence.push_back(greyOf(layers));
        paint.fixtures.push_back(found.fixtures(p));
        paint.correction.push_back(found.correction(p));
        auto& textures = solved.textures;
        textures[PageTexture::direct].push_back(shrunk(direct, p, TexelFormat::rgb9e5));
        textures[PageTexture::indirect].push_back(shrunk(indirect, p, TexelFormat::rgb9e5));
        textures[PageTexture::albedo].push_back(shrunk(paint.albedo.back(), p, TexelFormat::srgb8));
        textures[PageTexture::confidence].push_back(
            shrunk(paint.confidence.back(), p, TexelFormat::grey8));
        progress.check();
    }
    return paint;
}

/// All but the room, and its paint.
Paint tell(relamp::Decomposition found, const TextureLimits& limits, Solved& solved,
           relamp::Progress& progress)
{
    const relamp::Scan& scan = *found.scan();
    Paint paint = divide(found, PageShrinker(scan, limits), scan.pages.size(), solved, progress);
    solved.captured = found.lights();
    solved.albedo = found.optionsInForce().albedo;
    solved.closure = found.closure();
    solved.notes = found.warnings();
    solved.decomposition = std::make_shared<const relamp::Decomposition>(std::move(found));
    return paint;
}

/// What was said, of the fixtures that were found now.
ScannedItems itemsOf(const ScannedLight& scanned, const relamp::Lights& found)
{
    ScannedItems items = scanned.items;
    items.fixtures = carriedOver(scanned.items.fixtures, scanned.numbers, found, kAsFound);
    return items;
}

/// What a room of a folder looked like when it was scanned; without the scan, its albedo.
std::vector<TexturePixels> texturesOfScan(const relamp::DelitRoom& room,
                                          const relamp::ScanOptions& options,
                                          const PageShrinker& shrunk, relamp::Progress& progress,
                                          std::vector<std::string>& notes)
{
    try {
        return shrunk(relamp::readScanned(room, {.asScan = options}, progress), TexelFormat::srgb8);
    } catch (const relamp::Error& error) {
        if (error.code() == relamp::ErrorCode::cancelled) throw;
        notes.push_back(fmt::format("{}. The layer of the scan shows the albedo.", error.what()));
    }
    return shrunk.textures();
}

} // namespace

TexturePixels PageShrinker::operator()(const relamp::Image& image, size_t page,
                                       TexelFormat format) const
{
    return texturePixels(image, format, length_, !scan_->pages[page].ofVertices);
}

std::vector<TexturePixels> PageShrinker::operator()(const std::vector<relamp::Image>& images,
                                                    TexelFormat format) const
{
    std::vector<TexturePixels> pixels;
    for (size_t p = 0; p < images.size(); ++p) pixels.push_back((*this)(images[p], p, format));
    return pixels;
}

std::vector<TexturePixels> PageShrinker::textures() const
{
    std::vector<TexturePixels> pixels;
    for (size_t p = 0; p < scan_->pages.size(); ++p)
        pixels.push_back((*this)(scan_->pages[p].image, p, TexelFormat::srgb8));
    return pixels;
}

RoomSolver::RoomSolver(std::shared_ptr<const relamp::Scan> scan, const TextureLimits& limits)
    : limits_(limits), whole_(std::move(scan))
{}

Solved RoomSolver::solved(Side& side, const relamp::DelightOptions& options,
                          const ScannedLight& scanned, relamp::Progress& progress)
{
    Solved solved;
    relamp::Decomposition found = side.delighter.solve(options, progress);
    solved.found = side.found = found.lights();
    side.texels = found.texelCount();
    if (side.delighter.canReevaluate()) {
        solved.scanned = itemsOf(scanned, side.found);
        if (!solved.scanned.isAsFound())
            found = side.delighter.reevaluate(
                lightsUnder(solved.scanned, scanned.light, side.found), options.albedo, progress);
    }
    Paint paint = tell(std::move(found), limits_, solved, progress);
    auto room = std::make_shared<relamp::DelitRoom>();
    room->scan = side.scan;
    room->albedo = std::move(paint.albedo);
    room->confidence = std::move(paint.confidence);
    room->fixtures = std::move(paint.fixtures);
    room->correction = std::move(paint.correction);
    room->captured = solved.captured;
    room->gather = options.gather;
    solved.room = std::move(room);
    return solved;
}

void RoomSolver::solve(const relamp::DelightOptions& options, const ScannedLight& scanned,
                       const std::function<void(Solved)>& deliver, relamp::Progress& progress)
{
    const bool isGather = options.solver == relamp::Solver::gather;
    if (!isGather || options.gather.quality != relamp::Quality::draft) {
        relamp::DelightOptions quick = options;
        if (options.solver == relamp::Solver::pathtrace) quick.solver = relamp::Solver::gather;
        quick.gather.quality = relamp::Quality::draft;
        if (!draft_)
            draft_.emplace(std::make_shared<const relamp::Scan>(
                relamp::coarsened(*whole_.scan, kDraftLength)));
        Solved draft = solved(*draft_, quick, scanned, progress);
        draft.isDraft = true;
        deliver(std::move(draft));
    }
    Solved whole = solved(whole_, options, scanned, progress);
    const std::pair by{options.thesis.flattenReach, options.thesis.flattenRange};
    if (flattenedBy_ != by)
        whole.textures[PageTexture::flattened] = PageShrinker(*whole_.scan, limits_)(
            relamp::flattened(*whole_.scan, options.thesis, progress), TexelFormat::rgb9e5);
    flattenedBy_ = by;
    deliver(std::move(whole));
}

Solved RoomSolver::reevaluated(Side& side, const relamp::AlbedoOptions& albedo,
                               const ScannedLight& scanned, relamp::Progress& progress)
{
    Solved solved;
    solved.found = side.found;
    solved.scanned = scanned.items;
    const relamp::Lights lights =
        lightsUnder(itemsOf(scanned, side.found), scanned.light, side.found);
    solved.paint = std::make_shared<const Paint>(
        tell(side.delighter.reevaluate(lights, albedo, progress), limits_, solved, progress));
    return solved;
}

void RoomSolver::reevaluate(const relamp::AlbedoOptions& albedo, const ScannedLight& scanned,
                            const std::function<void(Solved)>& deliver, relamp::Progress& progress)
{
    if (whole_.texels > kTexelsAtOnce && draft_ && draft_->delighter.canReevaluate()) {
        Solved draft = reevaluated(*draft_, albedo, scanned, progress);
        draft.isDraft = true;
        deliver(std::move(draft));
    }
    deliver(reevaluated(whole_, albedo, scanned, progress));
}

Solved readSolved(const std::filesystem::path& folder, const relamp::ScanOptions& options,
                  const TextureLimits& limits, relamp::Progress& progress)
{
    auto room = std::make_shared<relamp::DelitRoom>(
        relamp::readDelitRoom(folder, {.asScan = options}, progress));
    Solved solved;
    solved.notes = room->warnings;
    const PageShrinker shrunk(*room->scan, limits);
    solved.photos = texturesOfScan(*room, options, shrunk, progress, solved.notes);
    solved.textures[PageTexture::albedo] = shrunk(room->albedo, TexelFormat::srgb8);
    if (!room->confidence.empty())
        solved.textures[PageTexture::confidence] = shrunk(room->confidence, TexelFormat::grey8);
    const size_t pages = room->scan->pages.size();
    const auto nameOf = [&](const char* layer, size_t p) {
        return pages == 1 ? fmt::format("{}.exr", layer) : fmt::format("{}.{}.exr", layer, p);
    };
    for (const auto& [which, layer] :
         {std::pair(PageTexture::direct, "direct"), std::pair(PageTexture::indirect, "indirect")}) {
        std::vector<relamp::Image> images;
        std::error_code ignored;
        for (size_t p = 0; p < pages && std::filesystem::exists(folder / nameOf(layer, p), ignored);
             ++p)
            images.push_back(relamp::readImage(folder / nameOf(layer, p)));
        if (images.size() == pages) solved.textures[which] = shrunk(images, TexelFormat::rgb9e5);
    }
    solved.captured = solved.found = room->captured;
    solved.room = std::move(room);
    return solved;
}
