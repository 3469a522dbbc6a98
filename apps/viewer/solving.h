#pragma once

#include "layers.h"
#include "texture_pixels.h"

#include "relamp/delight.h"
#include "relamp/relight.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

/// The light of a room, found; and its pictures, ready for the graphics device.
struct Solved
{
    std::shared_ptr<const relamp::DelitRoom> room;
    std::map<PageTexture, std::vector<TexturePixels>> textures; // one a page
    std::shared_ptr<const relamp::Decomposition> decomposition; // of `scan`; none of a folder
    std::shared_ptr<const relamp::Scan> scan;                   // that it was made from
    relamp::Closure closure;
    std::vector<std::string> notes;
    bool isDraft = false;
};

/// What a graphics device takes of a page at most, in pixels along its longer side.
constexpr uint32_t kLargestTexture = 4096;

/// Pixels of pages in the format that suits what they show.
std::vector<TexturePixels> pixelsOfPages(const std::vector<relamp::Image>& images,
                                         const relamp::Scan& scan, TexelFormat format);

/// Takes the light out of a scan; calls `deliver` with a draft of it first, where the scan is large
/// or the quality is not a draft's anyway, then with the whole.
void solve(const std::shared_ptr<const relamp::Scan>& scan, const relamp::DelightOptions& options,
           const std::function<void(Solved)>& deliver, relamp::Progress& progress);

/// What relamp delight has found before, in its folder.
Solved readSolved(const std::filesystem::path& folder, relamp::Progress& progress);
