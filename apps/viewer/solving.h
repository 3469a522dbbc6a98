#pragma once

#include "layers.h"
#include "light_document.h"
#include "texture_pixels.h"

#include "relamp/delighter.h"
#include "relamp/relight.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Surfaces of a room, a page each.
struct Paint
{
    std::vector<relamp::Image> albedo;
    std::vector<relamp::Image> confidence;
    std::vector<relamp::FixtureMap> fixtures;
    std::vector<relamp::CorrectionMap> correction;
};

/// How a room's light was on the day of the scan, as a person says.
struct ScannedLight
{
    ScannedItems items;
    std::vector<int> numbers; // of its fixtures
    LightDocument light;      // of which white counts
};

/// The light of a room, found; and its pictures, ready for the graphics device.
struct Solved
{
    std::shared_ptr<const relamp::DelitRoom> room; // none where it is the one before with `paint`
    std::shared_ptr<const Paint> paint;
    std::map<PageTexture, std::vector<TexturePixels>> textures; // one a page
    std::vector<TexturePixels> photos; // of a folder: the pictures of its scan, one a page
    std::shared_ptr<const relamp::Decomposition> decomposition; // none of a folder
    relamp::Lights captured;                                    // by which the albedo was found
    relamp::Lights found; // before anybody said how it was on the day of the scan
    ScannedItems scanned; // what was said
    relamp::AlbedoOptions albedo;
    relamp::Closure closure;
    std::vector<std::string> notes;
    bool isDraft = false;
};

/// Pictures of pages as a graphics device takes them.
class PageShrinker
{
public:
    PageShrinker(const relamp::Scan& scan, const TextureLimits& limits)
        : scan_(&scan), length_(limits.lengthFor(scan))
    {}

    /// A picture of a page.
    [[nodiscard]] TexturePixels operator()(const relamp::Image& image, size_t page,
                                           TexelFormat format) const;
    /// One of each page.
    [[nodiscard]] std::vector<TexturePixels> operator()(const std::vector<relamp::Image>& images,
                                                        TexelFormat format) const;
    /// The scan's own.
    [[nodiscard]] std::vector<TexturePixels> textures() const;

private:
    const relamp::Scan* scan_;
    uint32_t length_;
};

/// Takes the light out of a scan, again and again. To be used by one thread at a time.
class RoomSolver
{
public:
    RoomSolver(std::shared_ptr<const relamp::Scan> scan, const TextureLimits& limits);

    /// Calls `deliver` with a draft first, where the scan is large or the quality is not a draft's
    /// anyway, then with the whole.
    void solve(const relamp::DelightOptions& options, const ScannedLight& scanned,
               const std::function<void(Solved)>& deliver, relamp::Progress& progress);

    /// The whole again, where light is said to have been otherwise, or the albedo's options are
    /// others. The solver gather has solved it before. Of a large scan the draft comes first.
    void reevaluate(const relamp::AlbedoOptions& albedo, const ScannedLight& scanned,
                    const std::function<void(Solved)>& deliver, relamp::Progress& progress);

private:
    /// A scan as one of the solvers takes it.
    struct Side
    {
        explicit Side(std::shared_ptr<const relamp::Scan> of) : scan(std::move(of)), delighter(scan)
        {}

        std::shared_ptr<const relamp::Scan> scan;
        relamp::Delighter delighter;
        relamp::Lights found;
        size_t texels = 0;
    };

    Solved solved(Side& side, const relamp::DelightOptions& options, const ScannedLight& scanned,
                  relamp::Progress& progress);
    Solved reevaluated(Side& side, const relamp::AlbedoOptions& albedo, const ScannedLight& scanned,
                       relamp::Progress& progress);

    TextureLimits limits_;
    Side whole_;
    std::optional<Side> draft_;
    std::optional<std::pair<float, float>> flattenedBy_; // reach and range that were delivered
};

/// What relamp delight has found before, in its folder.
Solved readSolved(const std::filesystem::path& folder, const relamp::ScanOptions& options,
                  const TextureLimits& limits, relamp::Progress& progress);
