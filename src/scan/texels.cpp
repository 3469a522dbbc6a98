#include "scan/texels.h"

#include "base/fail.h"
#include "scan/atlas_raster.h"
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

constexpr double kMostSurfels = 1.5e6;
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

uint32_t widthOf(const Texels& texels, size_t page)
{
    return static_cast<uint32_t>(texels.scan->pages[page].image.width);
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

double surfelSizeFor(const Texels& texels, const std::vector<PageCoverage>& coverages,
                     const SurfelOptions& options)
{
    size_t count = 0;
    for (const PageCoverage& coverage : coverages) count += coverage.pixel.size();
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

/// Sorts a page's texels by surfel; those of one surfel stay in the order of their pixels.
PageTexels sortBySurfel(const PageCoverage& coverage, const PageKeys& keys,
                        const std::vector<uint64_t>& surfelKeys)
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
    forEach(keys.distinct.size(), [&](size_t i) {
        const auto surfel =
            std::lower_bound(surfelKeys.begin(), surfelKeys.end(), keys.distinct[i]);
        page.runs[i] = {static_cast<uint32_t>(surfel - surfelKeys.begin()), next[i]};
    });
    page.pixel.resize(count);
    page.facet.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t target = next[slot[i]]++;
        page.pixel[target] = coverage.pixel[i];
        page.facet[target] = coverage.facet[i];
    }
    return page;
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
    texels.facets = buildFacets(scan);

    std::vector<PageCoverage> coverages(pages);
    OverlapSum overlap;
    for (size_t p = 0; p < pages; ++p) {
        coverages[p] = rasterizePage(scan, texels.facets, static_cast<uint32_t>(p));
        texels.area += areaOf(texels, coverages[p]);
        overlap.add(coverages[p]);
        stage.advance();
    }

    texels.surfels.size = static_cast<float>(surfelSizeFor(texels, coverages, surfels));
    texels.surfels.seed = surfels.seed;
    texels.surfels.grid = gridOver(scan, texels.surfels.size);
    std::vector<PageKeys> keys(pages);
    std::vector<uint64_t> surfelKeys;
    for (size_t p = 0; p < pages; ++p) {
        keys[p] = keysOf(texels, coverages[p], p);
        surfelKeys.insert(surfelKeys.end(), keys[p].distinct.begin(), keys[p].distinct.end());
    }
    sortUnique(surfelKeys);

    texels.pages.resize(pages);
    for (size_t p = 0; p < pages; ++p) {
        texels.pages[p] = sortBySurfel(coverages[p], keys[p], surfelKeys);
        texels.pages[p].isShared = sharedPixels(coverages[p], scan.pages[p].image.pixels());
        coverages[p] = {};
        keys[p] = {};
        stage.advance();
    }
    texels.surfels.key = std::move(surfelKeys);
    sumSurfels(texels);
    if (surfels.layered) separateLayers(texels);
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
    const uint32_t pixel = pages[page].pixel[texel];
    const uint32_t width = widthOf(*this, page);
    return siteOn(facets.facets[pages[page].facet[texel]],
                  {static_cast<float>(pixel % width), static_cast<float>(pixel / width)});
}

SurfelSites::SurfelSites(const Texels& texels) : texels_(texels), ranges_(texels.surfels.count())
{
    for (uint32_t p = 0; p < texels.pages.size(); ++p) {
        const auto& runs = texels.pages[p].runs;
        for (size_t run = 0; run + 1 < runs.size(); ++run) {
            const uint32_t count = runs[run + 1].begin - runs[run].begin;
            Range& best = ranges_[runs[run].surfel];
            if (count > best.count) best = {p, runs[run].begin, count};
        }
    }
}

TexelSite SurfelSites::at(uint32_t surfel, size_t i) const
{
    const TexelIndex index = texelOf(surfel, i);
    return texels_.siteOf(index.page, index.texel);
}

TexelIndex SurfelSites::texelOf(uint32_t surfel, size_t i) const
{
    constexpr size_t kStride = 7919; // prime: visits all texels before it repeats
    const Range& range = ranges_[surfel];
    const size_t place = i + texels_.surfels.seed - 1;
    return {range.page, range.begin + static_cast<uint32_t>(place * kStride % range.count)};
}

TexelLoader::TexelLoader(const Texels& texels, size_t page, const Linearization* linearization)
    : texels_(texels), page_(texels.pages[page]),
      radiance_(texels.scan->pages[page].image,
                linearization != nullptr ? linearization->response : Response{}),
      width_(widthOf(texels, page)),
      perGain_(linearization != nullptr && !linearization->perGain.empty() ? &linearization->perGain
                                                                           : nullptr),
      tinted_(false)
{
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
    float columns[TexelBlock::kCapacity];
    float rows[TexelBlock::kCapacity];
    splitPixels({page_.pixel.data() + begin, count}, width_, columns, rows);
    const size_t last = page_.count() - 1;
    for (size_t i = 0; i < count; ++i) {
        __builtin_prefetch(&texels_.facets.facets[page_.facet[std::min(begin + i + kAhead, last)]]);
        const Facet& facet = texels_.facets.facets[page_.facet[begin + i]];
        const float dx = columns[i] - facet.pixel.x;
        const float dy = rows[i] - facet.pixel.y;
        block.x[i] = facet.position.x + dx * facet.positionX.x + dy * facet.positionY.x;
        block.y[i] = facet.position.y + dx * facet.positionX.y + dy * facet.positionY.y;
        block.z[i] = facet.position.z + dx * facet.positionX.z + dy * facet.positionY.z;
        block.nx[i] = facet.normal.x + dx * facet.normalX.x + dy * facet.normalY.x;
        block.ny[i] = facet.normal.y + dx * facet.normalX.y + dy * facet.normalY.y;
        block.nz[i] = facet.normal.z + dx * facet.normalX.z + dy * facet.normalY.z;
    }
    normalize(block);
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
    for (size_t i = 0; i < count; ++i)
        block.area[i] = texels_.facets.facets[page_.facet[begin + i]].texelArea;
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
