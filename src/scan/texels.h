#pragma once

#include "base/lanes.h"
#include "base/parallel.h"
#include "base/spill.h"
#include "relamp/inspect.h"
#include "relamp/progress.h"
#include "relamp/scan.h"
#include "scan/facets.h"
#include "scan/linearization.h"
#include "scan/surfels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// The covered texels of one page, in surface order: those of one surfel follow each other.
///
/// A texel is a pixel and the facet that it shows; all else follows from these two (loadBlock), so
/// a texel takes eight bytes and a page may be worked on without holding the others.
struct PageTexels
{
    struct Run
    {
        uint32_t surfel;
        uint32_t begin; // first texel; the run ends where the next begins
    };

    std::vector<uint32_t> pixel; // row * width + column
    std::vector<uint32_t> facet;
    std::vector<Run> runs;      // ascending; one more than there are, with begin = count()
    InFile isInFile;            // `pixel` and `facet`, as they are: see large_scan.h
    InFile isPictureInFile;     // likewise
    std::vector<bool> isShared; // of pixels: stands for places in different light; empty: none does

    [[nodiscard]] size_t count() const { return pixel.size(); }
    /// Index of the run that a texel belongs to.
    [[nodiscard]] size_t runOf(size_t texel) const;
};

/// A texel, wherever it is stored.
struct SiteOnPage
{
    uint32_t pixel;
    uint32_t facet;
};

/// Every place of the scan that shows light, as the stages see it.
struct Texels
{
    const Scan* scan = nullptr; // must outlive this
    Facets facets;
    std::vector<PageTexels> pages; // as Scan::pages
    Surfels surfels;
    double area = 0.0; // m^2 of all texels
    Overlap overlap;
    bool isLarge = false;            // texels and pictures lie in files: see large_scan.h
    std::vector<SiteOnPage> sites;   // if it is: what SurfelSites chooses from
    std::vector<uint32_t> firstSite; // of surfels, into `sites`, and one more

    /// A page is read soon.
    void willNeed(size_t page) const;
    /// A page is not read for a while: its texels and its picture leave RAM if they can.
    void letGo(size_t page) const;

    [[nodiscard]] size_t count() const;
    /// Where texel `texel` of a page lies.
    [[nodiscard]] TexelSite siteOf(size_t page, size_t texel) const;
};

struct TexelIndex
{
    uint32_t page;
    uint32_t texel; // of the page's
};

struct TexelRange
{
    uint32_t page = 0;
    uint32_t begin = 0; // of the page's texels
    uint32_t count = 0;
};

/// Texels of surfels, one after the other: where rays of a surfel start so that they average over
/// it.
class SurfelSites
{
public:
    explicit SurfelSites(const Texels& texels);

    /// Some texel of a surfel; consecutive `i` are spread over it.
    [[nodiscard]] TexelSite at(uint32_t surfel, size_t i) const;
    /// Which it is.
    [[nodiscard]] TexelIndex texelOf(uint32_t surfel, size_t i) const;
    /// How many `at` chooses from; the first that many `i` give each of them once.
    [[nodiscard]] size_t countOf(uint32_t surfel) const;
    /// Of the patterns that rays from them follow.
    [[nodiscard]] uint32_t seed() const { return texels_.surfels.seed; }

private:
    /// Which of those that it chooses from.
    [[nodiscard]] size_t placeOf(uint32_t surfel, size_t i) const;

    const Texels& texels_;
    std::vector<TexelRange> ranges_; // on the page where a surfel has most of its texels
};

/// Moves a page's texels to a file; to be called whenever they were changed.
void spillTexels(PageTexels& page);

/// Of a large scan, keeps what SurfelSites needs; to be called whenever texels were sorted anew.
void keepSites(Texels& texels);

struct SurfelOptions
{
    double texelsAcross = 4.0; // of a mean texel's width in a surfel, >= 1
    double smallest = 0.03;    // m
    double largest = 0.12;     // m
    bool layered = false;      // one surfel a layer: see separateLayers
    bool connected = true;     // else separateEnclosed follows and finds their neighbours
    uint32_t seed = 1; // of the patterns in which surfels and their surroundings are sampled

    bool operator==(const SurfelOptions&) const = default;
};

/// Rasterises the atlas once and sorts its texels into surfels.
Texels rasterizeAtlas(const Scan& scan, Progress& progress, const SurfelOptions& surfels = {});

/// A few texels as structure of arrays, the shape that all kernels work on. A kernel may read a
/// group of lanes behind the last texel: what is there counts for nothing, but it is a number.
struct TexelBlock
{
    static constexpr size_t kCapacity = 512;
    static constexpr size_t kPadded = kCapacity + kLanes;

    size_t count = 0;
    alignas(64) float x[kPadded] = {}, y[kPadded] = {}, z[kPadded] = {};    // world position, m
    alignas(64) float nx[kPadded] = {}, ny[kPadded] = {}, nz[kPadded] = {}; // unit normal
    alignas(64) float r[kPadded] = {}, g[kPadded] = {}, b[kPadded] = {};    // radiance, linear
    alignas(64) float area[kCapacity] = {};                                 // m^2
    uint32_t surfel[kCapacity] = {};

    /// One more texel, of which nothing else is known.
    void add(glm::vec3 position, glm::vec3 normal)
    {
        x[count] = position.x;
        y[count] = position.y;
        z[count] = position.z;
        nx[count] = normal.x;
        ny[count] = normal.y;
        nz[count] = normal.z;
        ++count;
    }
};

/// RGB of a block of texels, structure of arrays. Entries behind the block's last texel are
/// unspecified.
struct RgbBlock
{
    alignas(64) float r[TexelBlock::kPadded];
    alignas(64) float g[TexelBlock::kPadded];
    alignas(64) float b[TexelBlock::kPadded];
};

/// Fills `block` with texels [begin, begin + count) of a page; count <= kCapacity.
///
/// One loader serves many blocks of one page, and lets go of it at its end. Thread safe.
class TexelLoader
{
public:
    /// `linearization`, if not null, must outlive this.
    TexelLoader(const Texels& texels, size_t page, const Linearization* linearization = nullptr);
    ~TexelLoader() { texels_.letGo(index_); }
    TexelLoader(const TexelLoader&) = delete;
    TexelLoader& operator=(const TexelLoader&) = delete;

    void load(size_t begin, size_t count, TexelBlock& block) const;         // geometry and radiance
    void loadGeometry(size_t begin, size_t count, TexelBlock& block) const; // position and normal
    void loadRadiance(size_t begin, size_t count, TexelBlock& block) const;
    void loadArea(size_t begin, size_t count, TexelBlock& block) const;
    void loadSurfel(size_t begin, size_t count, TexelBlock& block) const;

private:
    void tint(size_t begin, TexelBlock& block) const;
    void takeGainOut(size_t begin, TexelBlock& block) const;

    const Texels& texels_;
    size_t index_;
    const PageTexels& page_;
    Radiance radiance_;
    uint32_t width_;
    const std::vector<glm::vec3>* perGain_; // or null
    bool tinted_; // a mesh of this page has a colour of its own beside the page
};

/// Fills `block` with position and normal of surfels [begin, end), as if each were a texel; at most
/// kCapacity.
void loadSurfels(const Surfels& surfels, size_t begin, size_t end, TexelBlock& block);

/// Calls `work(begin, count)` for all texels of a page in blocks, on all threads.
template<class Work>
void forEachBlock(const PageTexels& page, const Work& work)
{
    forEachChunk(page.count(), TexelBlock::kCapacity,
                 [&](size_t begin, size_t end) { work(begin, end - begin); });
}

/// Calls `work(begin, count)` for the texels of one run, in order.
template<class Work>
void forEachBlockOfRun(const PageTexels& page, size_t run, const Work& work)
{
    const size_t end = page.runs[run + 1].begin;
    for (size_t begin = page.runs[run].begin; begin < end; begin += TexelBlock::kCapacity)
        work(begin, std::min(TexelBlock::kCapacity, end - begin));
}

/// Calls `work(run, block)` for all runs of a page, on all threads. `block` is room to work in; it
/// is lent from run to run, so that it is not made anew for a dozen texels.
template<class Work>
void forEachRun(const PageTexels& page, const Work& work)
{
    forEachChunk(page.runs.size() - 1, 64, [&](size_t first, size_t last) {
        TexelBlock block;
        for (size_t run = first; run < last; ++run) work(run, block);
    });
}

} // namespace relamp
