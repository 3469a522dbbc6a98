#include "scan/texels.h"

#include "base/fail.h"
#include "base/instruction_set.h"
#include "base/spill.h"
#include "scan/atlas_raster.h"
#include "scan/large_scan.h"
#include "scan/split_surfels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr double kMostSurfels = 0.75e6;
constexpr uint32_t kMostSites = 32; // of a surfel of a large scan: where rays start, and are even
constexpr size_t kChunk = size_t{1} << 16;
constexpr size_t kAhead =
    24; // texels; surface order jumps over the page, and a look ahead hides that

/// Columns and rows of pixels, without an integer division: half a pixel keeps the quotient clear
/// of whole numbers, which a double's rounding could miss.
void splitPixels(std::span<const uint32_t> pixels, uint32_t width, float* columns, float* rows)
{
    const double perWidth = 1.0 / width;
    for (size_t i = 0; i < pixels.size(); ++i) {
        const auto row = static_cast<int32_t>((pixels[i] + 0.5) * perWidth);
        rows[i] = static_cast<float>(row);
        columns[i] =
            static_cast<float>(static_cast<int32_t>(pixels[i]) - row * static_cast<int32_t>(width));
    }
}

void normalize(TexelBlock& block)
{
    for (size_t i = 0; i < block.count; ++i) {
        const float squared =
            block.nx[i] * block.nx[i] + block.ny[i] * block.ny[i] + block.nz[i] * block.nz[i];
        const float scale = 1.0f / std::sqrt(squared > 1e-24f ? squared : 1e-24f);
        block.nx[i] *= scale;
        block.ny[i] *= scale;
        block.nz[i] *= scale;
    }
}

/// Texels of a page, from `begin` on.
struct Places
{
    const Facet* facets;
    const PageTexels& page;
    uint32_t width;
    size_t begin;
};

void placeKernel(const Places& places, TexelBlock& block)
{
    float columns[TexelBlock::kCapacity];
    float rows[TexelBlock::kCapacity];
    const auto& [facets, page, width, begin] = places;
    splitPixels({page.pixel.data() + begin, block.count}, width, columns, rows);
    const size_t last = page.count() - 1;
    alignas(64) float place[kLanes][8] = {};
    for (size_t first = 0; first < block.count; first += kLanes) {
        const size_t end = std::min(kLanes, block.count - first);
        for (size_t lane = 0; lane < end; ++lane) {
            const size_t i = first + lane;
            __builtin_prefetch(&facets[page.facet[std::min(begin + i + kAhead, last)]]);
            placeOn(facets[page.facet[begin + i]], {columns[i], rows[i]}, place[lane]);
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            block.x[first + lane] = place[lane][0];
            block.y[first + lane] = place[lane][1];
            block.z[first + lane] = place[lane][2];
            block.nx[first + lane] = place[lane][3];
            block.ny[first + lane] = place[lane][4];
            block.nz[first + lane] = place[lane][5];
        }
    }
    normalize(block);
}

uint32_t widthOf(const Texels& texels, size_t page)
{
    return static_cast<uint32_t>(texels.scan->pages[page].image.width);
}

TexelSite siteOf(const Texels& texels, size_t page, SiteOnPage site)
{
    const uint32_t width = widthOf(texels, page);
    return siteOn(texels.facets.facets[site.facet],
                  {static_cast<float>(site.pixel % width), static_cast<float>(site.pixel / width)});
}

std::vector<TexelRange> rangesOf(const Texels& texels)
{
    std::vector<TexelRange> ranges(texels.surfels.count());
    for (uint32_t p = 0; p < texels.pages.size(); ++p) {
        const auto& runs = texels.pages[p].runs;
        for (size_t run = 0; run + 1 < runs.size(); ++run) {
            const uint32_t count = runs[run + 1].begin - runs[run].begin;
            TexelRange& best = ranges[runs[run].surfel];
            if (count > best.count) best = {p, runs[run].begin, count};
        }
    }
    return ranges;
}

/// One of `count` texels that lie evenly in a range.
uint32_t texelOfSite(TexelRange range, size_t site, size_t count)
{
    return range.begin + static_cast<uint32_t>(site * range.count / count);
}

double areaOf(const Texels& texels, const PageCoverage& coverage)
{
    std::vector<double> sums((coverage.facet.size() + kChunk - 1) / kChunk, 0.0);
    forEachChunk(coverage.facet.size(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            sums[begin / kChunk] +=
                static_cast<double>(texels.facets.facets[coverage.facet[i]].texelArea);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double surfelSizeFor(const Texels& texels, size_t count, const SurfelOptions& options)
{
    const double texel = std::sqrt(texels.area / static_cast<double>(std::max<size_t>(count, 1)));
    const double size = std::max(
        std::clamp(options.texelsAcross * texel, options.smallest, options.largest), texel);
    const double extent = glm::length(boundsOf(*texels.scan).extent());
    return std::max({size, std::sqrt(texels.area / kMostSurfels), extent / SurfelGrid::kMostCells});
}

/// From the low corner of all triangles: a vertex that none uses may lie anywhere.
SurfelGrid gridOver(const Scan& scan, float size)
{
    const WallFrame frame = wallFrameOf(scan);
    glm::vec3 low(std::numeric_limits<float>::max());
    for (const Mesh& mesh : scan.meshes)
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int c = 0; c < 3; ++c)
                low = glm::min(low, frame.fromScan(mesh.positions[triangle[c]]));
    return {frame, low, size};
}

/// Keys of all texels of a page, and the ascending keys that occur in it.
struct PageKeys
{
    std::vector<uint64_t> ofTexel;
    std::vector<uint64_t> distinct;
};

void sortUnique(std::vector<uint64_t>& keys)
{
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

PageKeys keysOf(const Texels& texels, const PageCoverage& coverage, size_t page)
{
    const uint32_t width = widthOf(texels, page);
    PageKeys keys;
    keys.ofTexel.resize(coverage.pixel.size());
    std::vector<std::vector<uint64_t>> ofChunk((coverage.pixel.size() + kChunk - 1) / kChunk);
    forEachChunk(coverage.pixel.size(), kChunk, [&](size_t begin, size_t end) {
        std::vector<uint64_t>& distinct = ofChunk[begin / kChunk];
        for (size_t i = begin; i < end; ++i) {
            const uint32_t pixel = coverage.pixel[i];
            const TexelSite site =
                siteOn(texels.facets.facets[coverage.facet[i]],
                       {static_cast<float>(pixel % width), static_cast<float>(pixel / width)});
            keys.ofTexel[i] = texels.surfels.grid.keyOf(site.position, site.normal);
            if (distinct.empty() || distinct.back() != keys.ofTexel[i])
                distinct.push_back(keys.ofTexel[i]);
        }
        sortUnique(distinct);
    });
    for (const auto& distinct : ofChunk)
        keys.distinct.insert(keys.distinct.end(), distinct.begin(), distinct.end());
    sortUnique(keys.distinct);
    return keys;
}

/// Sorts a page's texels by surfel; those of one surfel stay in the order of their pixels. Runs
/// have the place of their key among the page's.
PageTexels sortBySurfel(const PageCoverage& coverage, const PageKeys& keys)
{
    const size_t count = coverage.pixel.size();
    std::vector<uint32_t> slot(count); // index into keys.distinct
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const bool asBefore = i > begin && keys.ofTexel[i] == keys.ofTexel[i - 1];
            slot[i] =
                asBefore
                    ? slot[i - 1]
                    : static_cast<uint32_t>(std::lower_bound(keys.distinct.begin(),
                                                             keys.distinct.end(), keys.ofTexel[i]) -
                                            keys.distinct.begin());
        }
    });
    std::vector<uint32_t> next(keys.distinct.size() + 1, 0);
    for (const uint32_t s : slot) ++next[s + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());

    PageTexels page;
    page.runs.resize(keys.distinct.size() + 1, {0, static_cast<uint32_t>(count)});
    for (uint32_t i = 0; i < keys.distinct.size(); ++i) page.runs[i] = {i, next[i]};
    page.pixel.resize(count);
    page.facet.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t target = next[slot[i]]++;
        page.pixel[target] = coverage.pixel[i];
        page.facet[target] = coverage.facet[i];
    }
    return page;
}

/// Gives the runs the numbers of their surfels.
void numberRuns(const std::vector<uint64_t>& keysOfPage, const std::vector<uint64_t>& surfelKeys,
                PageTexels& page)
{
    forEach(keysOfPage.size(), [&](size_t i) {
        const auto surfel = std::lower_bound(surfelKeys.begin(), surfelKeys.end(), keysOfPage[i]);
        page.runs[i].surfel = static_cast<uint32_t>(surfel - surfelKeys.begin());
    });
}

/// Gathers what pages have of it.
class OverlapSum
{
public:
    void add(const PageCoverage& coverage)
    {
        for (const auto& shared : coverage.shared)
            if (shared.isWanted) texels_[static_cast<size_t>(shared.kind)] += 1.0;
        texels_[static_cast<size_t>(OverlapKind::tiled)] += coverage.outside;
        for (const auto& [mesh, texels] : coverage.inMesh) inMesh_[mesh] += texels;
    }
    [[nodiscard]] Overlap result(const Scan& scan, double covered) const;

private:
    std::array<double, kOverlapKinds> texels_{};
    std::map<uint32_t, double> inMesh_;
};

Overlap OverlapSum::result(const Scan& scan, double covered) const
{
    constexpr size_t kMostNames = 5;
    double sum = 0.0;
    for (const double texels : texels_) sum += texels;
    const auto share = [&](OverlapKind kind) { // what lies beyond the page may be more than all
        return texels_[static_cast<size_t>(kind)] / std::max({sum, covered, 1.0});
    };
    Overlap overlap{.tiled = share(OverlapKind::tiled),
                    .mirrored = share(OverlapKind::mirrored),
                    .copied = share(OverlapKind::copied),
                    .opposite = share(OverlapKind::opposite),
                    .alike = share(OverlapKind::alike)};
    std::vector<std::pair<double, uint32_t>> meshes;
    for (const auto& [mesh, texels] : inMesh_) meshes.emplace_back(-texels, mesh);
    std::sort(meshes.begin(), meshes.end());
    for (const auto& [texels, mesh] : meshes) {
        const std::string& name = scan.meshes[mesh].name;
        if (overlap.meshes.size() < kMostNames &&
            std::find(overlap.meshes.begin(), overlap.meshes.end(), name) == overlap.meshes.end())
            overlap.meshes.push_back(name);
    }
    return overlap;
}

/// Which pixels stand for places in different light; none: empty.
std::vector<bool> sharedPixels(const PageCoverage& coverage, size_t pixels)
{
    std::vector<bool> isShared;
    if (coverage.isOfSeamsAlone()) return isShared;
    for (const auto& shared : coverage.shared) {
        if (shared.kind == OverlapKind::alike) continue;
        isShared.resize(pixels);
        isShared[shared.pixel] = true;
    }
    return isShared;
}

} // namespace

size_t PageTexels::runOf(size_t texel) const
{
    const auto startsAfter = [](size_t t, const Run& run) { return t < run.begin; };
    return static_cast<size_t>(std::upper_bound(runs.begin(), runs.end(), texel, startsAfter) -
                               runs.begin()) -
           1;
}

size_t Texels::count() const
{
    size_t count = 0;
    for (const PageTexels& page : pages) count += page.count();
    return count;
}

Texels rasterizeAtlas(const Scan& scan, Progress& progress, const SurfelOptions& surfels)
{
    const size_t pages = scan.pages.size();
    Progress::Stage stage(progress, "texels", 2 * pages + 1);
    Texels texels;
    texels.scan = &scan;
    texels.isLarge = isLarge(scan);
    texels.facets = buildFacets(scan);

    std::vector<PageCoverage> coverages(pages);
    size_t count = 0;
    OverlapSum overlap;
    for (size_t p = 0; p < pages; ++p) {
        coverages[p] = rasterizePage(scan, texels.facets, static_cast<uint32_t>(p));
        texels.area += areaOf(texels, coverages[p]);
        overlap.add(coverages[p]);
        count += coverages[p].pixel.size();
        if (texels.isLarge) coverages[p] = {}; // it comes once more
        stage.advance();
    }

    texels.surfels.size = static_cast<float>(surfelSizeFor(texels, count, surfels));
    texels.surfels.seed = surfels.seed;
    texels.surfels.grid = gridOver(scan, texels.surfels.size);
    texels.pages.resize(pages);
    std::vector<std::vector<uint64_t>> keys(pages);
    for (size_t p = 0; p < pages; ++p) {
        if (texels.isLarge)
            coverages[p] = rasterizePage(scan, texels.facets, static_cast<uint32_t>(p));
        PageKeys ofPage = keysOf(texels, coverages[p], p);
        texels.pages[p] = sortBySurfel(coverages[p], ofPage);
        texels.pages[p].isShared = sharedPixels(coverages[p], scan.pages[p].image.pixels());
        keys[p] = std::move(ofPage.distinct);
        coverages[p] = {};
        if (texels.isLarge) {
            spillTexels(texels.pages[p]);
            texels.pages[p].isPictureInFile = spillPage(scan.pages[p]);
        }
        stage.advance();
    }
    std::vector<uint64_t> surfelKeys;
    for (const auto& ofPage : keys)
        surfelKeys.insert(surfelKeys.end(), ofPage.begin(), ofPage.end());
    sortUnique(surfelKeys);
    for (size_t p = 0; p < pages; ++p) numberRuns(keys[p], surfelKeys, texels.pages[p]);
    texels.surfels.key = std::move(surfelKeys);
    sumSurfels(texels);
    if (surfels.layered) separateLayers(texels);
    keepSites(texels);
    if (texels.isLarge) letGoOfFreed();
    if (surfels.connected) findNeighbors(texels.surfels);

    texels.overlap = overlap.result(scan, static_cast<double>(texels.count()));
    if (texels.count() == 0)
        fail(ErrorCode::unsupported, scan.title(),
             "no texel lies on any triangle: its texture coordinates have no extent. Unwrap it "
             "again");
    return texels;
}

TexelSite Texels::siteOf(size_t page, size_t texel) const
{
    return relamp::siteOf(*this, page, {pages[page].pixel[texel], pages[page].facet[texel]});
}

void Texels::willNeed(size_t page) const
{
    if (!isLarge) return;
    relamp::willNeed(pages[page].pixel);
    relamp::willNeed(pages[page].facet);
    relamp::willNeed(scan->pages[page]);
}

void Texels::letGo(size_t page) const
{
    if (pages[page].isInFile) {
        relamp::letGo(pages[page].pixel);
        relamp::letGo(pages[page].facet);
    }
    if (pages[page].isPictureInFile) relamp::letGo(scan->pages[page]);
}

void spillTexels(PageTexels& page)
{
    const bool pixels = spill(page.pixel);
    page.isInFile = spill(page.facet) && pixels;
}

void keepSites(Texels& texels)
{
    if (!texels.isLarge) return;
    const std::vector<TexelRange> ranges = rangesOf(texels);
    texels.firstSite.assign(ranges.size() + 1, 0);
    for (size_t s = 0; s < ranges.size(); ++s)
        texels.firstSite[s + 1] = texels.firstSite[s] + std::min(ranges[s].count, kMostSites);
    texels.sites.resize(texels.firstSite.back());
    for (uint32_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        texels.willNeed(p);
        forEach(page.runs.size() - 1, [&](size_t run) {
            const uint32_t s = page.runs[run].surfel;
            if (ranges[s].page != p) return;
            const uint32_t count = texels.firstSite[s + 1] - texels.firstSite[s];
            for (uint32_t i = 0; i < count; ++i) {
                const size_t at = texelOfSite(ranges[s], i, count);
                texels.sites[texels.firstSite[s] + i] = {page.pixel[at], page.facet[at]};
            }
        });
        texels.letGo(p);
    }
}

SurfelSites::SurfelSites(const Texels& texels) : texels_(texels), ranges_(rangesOf(texels)) {}

size_t SurfelSites::countOf(uint32_t surfel) const
{
    const uint32_t count = ranges_[surfel].count;
    return texels_.isLarge ? std::min(count, kMostSites) : count;
}

size_t SurfelSites::placeOf(uint32_t surfel, size_t i) const
{
    constexpr size_t kStride = 7919; // prime: visits all texels before it repeats
    return (i + texels_.surfels.seed - 1) * kStride % countOf(surfel);
}

TexelSite SurfelSites::at(uint32_t surfel, size_t i) const
{
    if (!texels_.isLarge) {
        const TexelIndex index = texelOf(surfel, i);
        return texels_.siteOf(index.page, index.texel);
    }
    return siteOf(texels_, ranges_[surfel].page,
                  texels_.sites[texels_.firstSite[surfel] + placeOf(surfel, i)]);
}

TexelIndex SurfelSites::texelOf(uint32_t surfel, size_t i) const
{
    const TexelRange& range = ranges_[surfel];
    return {range.page, texelOfSite(range, placeOf(surfel, i), countOf(surfel))};
}

TexelLoader::TexelLoader(const Texels& texels, size_t page, const Linearization* linearization)
    : texels_(texels), index_(page), page_(texels.pages[page]),
      radiance_(texels.scan->pages[page].image,
                linearization != nullptr ? linearization->response : Response{}),
      width_(widthOf(texels, page)),
      perGain_(linearization != nullptr && !linearization->perGain.empty() ? &linearization->perGain
                                                                           : nullptr),
      tinted_(false)
{
    texels.willNeed(page);
    for (const Mesh& mesh : texels.scan->meshes)
        if (mesh.page == static_cast<int>(page))
            tinted_ = tinted_ || mesh.factor != glm::vec3(1.0f) || !mesh.colors.empty();
}

void TexelLoader::load(size_t begin, size_t count, TexelBlock& block) const
{
    loadGeometry(begin, count, block);
    loadRadiance(begin, count, block);
}

void TexelLoader::loadGeometry(size_t begin, size_t count, TexelBlock& block) const
{
    block.count = count;
    const Places places{texels_.facets.facets.data(), page_, width_, begin};
    runKernel<placeKernel>(bestInstructionSet(), places, block);
}

void TexelLoader::loadRadiance(size_t begin, size_t count, TexelBlock& block) const
{
    block.count = count;
    const size_t last = page_.count() - 1;
    for (size_t i = 0; i < count; ++i) {
        radiance_.prefetch(page_.pixel[std::min(begin + i + kAhead, last)]);
        const glm::vec3 radiance = radiance_[page_.pixel[begin + i]];
        block.r[i] = radiance.r;
        block.g[i] = radiance.g;
        block.b[i] = radiance.b;
    }
    if (tinted_) tint(begin, block);
    if (perGain_ != nullptr) takeGainOut(begin, block);
}

void TexelLoader::takeGainOut(size_t begin, TexelBlock& block) const
{
    size_t run = page_.runOf(begin);
    for (size_t i = 0; i < block.count; ++i) {
        while (begin + i >= page_.runs[run + 1].begin) ++run;
        const glm::vec3 perGain = (*perGain_)[page_.runs[run].surfel];
        block.r[i] *= perGain.r;
        block.g[i] *= perGain.g;
        block.b[i] *= perGain.b;
    }
}

void TexelLoader::tint(size_t begin, TexelBlock& block) const
{
    for (size_t i = 0; i < block.count; ++i) {
        const uint32_t pixel = page_.pixel[begin + i];
        const uint32_t facet = page_.facet[begin + i];
        const Tint tint = tintOf(*texels_.scan, texels_.facets, facet);
        const glm::vec2 from = texels_.facets.facets[facet].pixel;
        const glm::vec3 color = tint.color +
                                (static_cast<float>(pixel % width_) - from.x) * tint.colorX +
                                (static_cast<float>(pixel / width_) - from.y) * tint.colorY;
        block.r[i] *= color.r;
        block.g[i] *= color.g;
        block.b[i] *= color.b;
    }
}

void TexelLoader::loadArea(size_t begin, size_t count, TexelBlock& block) const
{
    block.count = count;
    const std::vector<Facet>& facets = texels_.facets.facets;
    const size_t last = page_.count() - 1;
    for (size_t i = 0; i < count; ++i) {
        __builtin_prefetch(&facets[page_.facet[std::min(begin + i + kAhead, last)]].texelArea);
        block.area[i] = facets[page_.facet[begin + i]].texelArea;
    }
}

void TexelLoader::loadSurfel(size_t begin, size_t count, TexelBlock& block) const
{
    block.count = count;
    size_t run = page_.runOf(begin);
    for (size_t i = 0; i < count; ++i) {
        while (begin + i >= page_.runs[run + 1].begin) ++run;
        block.surfel[i] = page_.runs[run].surfel;
    }
}

void loadSurfels(const Surfels& surfels, size_t begin, size_t end, TexelBlock& block)
{
    block.count = 0;
    for (size_t s = begin; s < end; ++s) block.add(surfels.position[s], surfels.normal[s]);
}

} // namespace relamp
