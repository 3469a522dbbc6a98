#include "solving.h"

#include "parallel.h"

#include "relamp/flattened.h"

#include <algorithm>

#include <fmt/format.h>

namespace
{

constexpr int kDraftLength = 1024; // pixels

relamp::Image imageOf(const relamp::PageLayers& layers, std::vector<uint16_t> half)
{
    relamp::Image image;
    image.width = layers.width;
    image.height = layers.height;
    image.transfer = relamp::Transfer::linear;
    image.clipsAtWhite = false;
    image.half = std::move(half);
    return image;
}

relamp::Image greyOf(const relamp::PageLayers& layers)
{
    relamp::Image image;
    image.width = layers.width;
    image.height = layers.height;
    image.encoded.resize(3 * layers.confidence.size());
    for (size_t i = 0; i < layers.confidence.size(); ++i)
        std::fill_n(&image.encoded[3 * i], 3, layers.confidence[i]);
    return image;
}

TexturePixels pixelsOf(const relamp::Image& image, const relamp::Page& page, TexelFormat format)
{
    return texturePixels(image, format, kLargestTexture, !page.ofVertices);
}

/// Divides page after page, and keeps of each what is shown and what relighting needs.
Solved solvedOf(std::shared_ptr<const relamp::Scan> scan, const relamp::DelightOptions& options,
                relamp::Progress& progress)
{
    Solved solved;
    auto found = std::make_shared<relamp::Decomposition>(relamp::delight(*scan, options, progress));
    auto room = std::make_shared<relamp::DelitRoom>();
    for (size_t p = 0; p < scan->pages.size(); ++p) {
        relamp::PageLayers layers = found->layers(p, progress);
        const relamp::Page& page = scan->pages[p];
        const relamp::Image direct = imageOf(layers, std::move(layers.direct));
        const relamp::Image indirect = imageOf(layers, std::move(layers.indirect));
        room->albedo.push_back(imageOf(layers, std::move(layers.albedo)));
        room->confidence.push_back(greyOf(layers));
        auto& textures = solved.textures;
        textures[PageTexture::direct].push_back(pixelsOf(direct, page, TexelFormat::rgb9e5));
        textures[PageTexture::indirect].push_back(pixelsOf(indirect, page, TexelFormat::rgb9e5));
        textures[PageTexture::albedo].push_back(
            pixelsOf(room->albedo.back(), page, TexelFormat::srgb8));
        textures[PageTexture::confidence].push_back(
            pixelsOf(room->confidence.back(), page, TexelFormat::grey8));
        progress.check();
    }
    room->scan = *scan;
    room->captured = found->lights();
    room->gather = options.gather;
    solved.room = room;
    solved.closure = found->closure();
    solved.notes = found->warnings();
    solved.decomposition = found;
    solved.scan = std::move(scan);
    return solved;
}

} // namespace

std::vector<TexturePixels> pixelsOfPages(const std::vector<relamp::Image>& images,
                                         const relamp::Scan& scan, TexelFormat format)
{
    std::vector<TexturePixels> pixels;
    for (size_t p = 0; p < images.size(); ++p)
        pixels.push_back(pixelsOf(images[p], scan.pages[p], format));
    return pixels;
}

void solve(const std::shared_ptr<const relamp::Scan>& scan, const relamp::DelightOptions& options,
           const std::function<void(Solved)>& deliver, relamp::Progress& progress)
{
    const bool isGather = options.solver == relamp::Solver::gather;
    if (!isGather || options.gather.quality != relamp::Quality::draft) {
        relamp::DelightOptions quick = options;
        if (options.solver == relamp::Solver::pathtrace) quick.solver = relamp::Solver::gather;
        quick.gather.quality = relamp::Quality::draft;
        const auto coarse =
            std::make_shared<const relamp::Scan>(relamp::coarsened(*scan, kDraftLength));
        Solved draft = solvedOf(coarse, quick, progress);
        draft.isDraft = true;
        deliver(std::move(draft));
    }
    Solved whole = solvedOf(scan, options, progress);
    whole.textures[PageTexture::flattened] = pixelsOfPages(
        relamp::flattened(*scan, options.thesis, progress), *scan, TexelFormat::rgb9e5);
    deliver(std::move(whole));
}

Solved readSolved(const std::filesystem::path& folder, relamp::Progress& progress)
{
    auto room = std::make_shared<relamp::DelitRoom>(relamp::readDelitRoom(folder, {}, progress));
    Solved solved;
    solved.notes = room->warnings;
    solved.textures[PageTexture::albedo] =
        pixelsOfPages(room->albedo, room->scan, TexelFormat::srgb8);
    if (!room->confidence.empty())
        solved.textures[PageTexture::confidence] =
            pixelsOfPages(room->confidence, room->scan, TexelFormat::grey8);
    const size_t pages = room->scan.pages.size();
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
        if (images.size() == pages)
            solved.textures[which] = pixelsOfPages(images, room->scan, TexelFormat::rgb9e5);
    }
    solved.scan = std::shared_ptr<const relamp::Scan>(room, &room->scan);
    solved.room = std::move(room);
    return solved;
}
