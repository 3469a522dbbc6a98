#include "scan/atlas_raster.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

constexpr uint32_t kNobody = ~0u;
constexpr int kRowsOfBand = 32;
constexpr uint8_t kRepeated = 1u << kOverlapKinds; // a bit beside those of OverlapKind
constexpr double kInside =
    0.01; // pixels from every edge; nearer, two neighbours may both touch a centre

struct Row
{
    double begin;
    double end;

    /// Keeps where a * x + c >= 0.
    void cut(double a, double c)
    {
        if (a > 0.0)
            begin = std::max(begin, -c / a);
        else if (a < 0.0)
            end = std::min(end, -c / a);
        else if (c < 0.0)
            end = begin - 1.0;
    }
};

/// A triangle by its three edges: inside is where all of x * a + y * b + c are >= 0, in pixels.
struct EdgeTriangle
{
    explicit EdgeTriangle(const PixelTriangle& t)
    {
        const glm::dvec2 e1 = t.corner[1] - t.corner[0];
        const glm::dvec2 e2 = t.corner[2] - t.corner[0];
        const double turn = e1.x * e2.y - e1.y * e2.x < 0.0 ? -1.0 : 1.0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 from = t.corner[k];
            const glm::dvec2 edge = t.corner[(k + 1) % 3] - from;
            const double length = std::max(std::hypot(edge.x, edge.y), 1e-12);
            a[k] = -turn * edge.y / length;
            b[k] = turn * edge.x / length;
            c[k] = -(a[k] * from.x + b[k] * from.y);
        }
    }

    /// Columns of row `y` that lie at least `margin` pixels inside.
    [[nodiscard]] Row row(double y, double margin) const
    {
        Row row{-1e15, 1e15};
        for (int k = 0; k < 3; ++k) row.cut(a[k], b[k] * y + c[k] - margin);
        return row;
    }

    double a[3];
    double b[3];
    double c[3];
};

struct PageSize
{
    int width;
    int height;
};

/// Which tile a triangle lies on; of axes that are not repeated, the first.
glm::ivec2 tileOf(const Mesh& mesh, const glm::uvec3& triangle)
{
    constexpr double kFar = 1e9;
    const glm::dvec2 sum = glm::dvec2(mesh.uvs[triangle.x]) + glm::dvec2(mesh.uvs[triangle.y]) +
                           glm::dvec2(mesh.uvs[triangle.z]);
    const glm::dvec2 tile = glm::clamp(glm::floor(sum / 3.0), -kFar, kFar);
    return {mesh.wrapU == Wrap::clamp ? 0 : static_cast<int>(tile.x),
            mesh.wrapV == Wrap::clamp ? 0 : static_cast<int>(tile.y)};
}

using Polygon = std::vector<glm::dvec2>;

/// Keeps what lies where sign * (coordinate `axis` - limit) <= 0 (Sutherland and Hodgman 1974).
Polygon cutOff(const Polygon& polygon, int axis, double limit, double sign)
{
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i];
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
        const double beyondA = sign * (a[axis] - limit);
        const double beyondB = sign * (b[axis] - limit);
        if (beyondA <= 0.0) kept.push_back(a);
        if (beyondA * beyondB < 0.0) kept.push_back(a + beyondA / (beyondA - beyondB) * (b - a));
    }
    return kept;
}

double areaOf(const Polygon& polygon)
{
    double twice = 0.0;
    for (size_t i = 2; i < polygon.size(); ++i) {
        const glm::dvec2 e1 = polygon[i - 1] - polygon[0];
        const glm::dvec2 e2 = polygon[i] - polygon[0];
        twice += e1.x * e2.y - e1.y * e2.x;
    }
    return 0.5 * std::abs(twice);
}

/// Texels of a triangle that lie beyond the page, whose edge is half a pixel from the outermost
/// centres.
double areaOutside(const PixelTriangle& t, PageSize size)
{
    const glm::dvec2 high(size.width - 0.5, size.height - 0.5);
    const auto isOnPage = [&](const glm::dvec2& p) {
        return p.x >= -0.5 && p.y >= -0.5 && p.x <= high.x && p.y <= high.y;
    };
    if (std::all_of(std::begin(t.corner), std::end(t.corner), isOnPage)) return 0.0;
    const Polygon whole(std::begin(t.corner), std::end(t.corner));
    Polygon inside = whole;
    for (int axis = 0; axis < 2; ++axis) {
        inside = cutOff(inside, axis, -0.5, -1.0);
        inside = cutOff(inside, axis, high[axis], 1.0);
    }
    return std::max(0.0, areaOf(whole) - areaOf(inside));
}

/// Rows that a facet may touch, on the page; empty where begin >= end.
struct RowRange
{
    int begin = 0;
    int end = 0;
};

RowRange rowsOf(const PixelTriangle& t, int height)
{
    const auto [low, high] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    return {static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(height)))),
            static_cast<int>(std::floor(std::clamp(high, -1.0, height - 1.0))) + 1};
}

/// Whole columns of [row.begin, row.end] that lie on the page.
RowRange columnsOf(const Row& row, int width)
{
    const double first = std::ceil(std::clamp(row.begin, 0.0, static_cast<double>(width)));
    const double last = std::floor(std::clamp(row.end, -1.0, width - 1.0));
    return {static_cast<int>(first), static_cast<int>(last) + 1};
}

class PageRaster
{
public:
    PageRaster(const Scan& scan, const Facets& facets, uint32_t page);
    PageCoverage run();

private:
    struct Candidate
    {
        uint32_t facet;
        PixelTriangle triangle;
        RowRange rows;
        glm::ivec2 tile;     // of the plane that the page repeats over
        bool isCopy = false; // what lies beyond the page, moved to where the page shows it
    };
    /// Rows that are drawn together.
    struct Band
    {
        int firstRow;
        std::vector<uint32_t> owner;      // of pixels: index of a candidate
        std::vector<uint8_t> kinds;       // of pixels: a bit for each OverlapKind and kRepeated
        std::map<size_t, uint32_t> front; // of pixels that skins share: the candidate that is seen
    };

    void collect(uint32_t page);
    void addCopies(const Candidate& candidate, const Mesh& mesh);
    void add(const Candidate& candidate);
    void sortIntoBands();
    void drawBand(int index, PageCoverage& coverage) const;
    void drawFacet(uint32_t index, RowRange rows, Band& band, PageCoverage& coverage) const;
    void contest(uint32_t index, glm::ivec2 pixel, size_t at, Band& band,
                 PageCoverage& coverage) const;

    const Scan& scan_;
    const Facets& facets_;
    PageSize size_;
    std::vector<Candidate> candidates_;
    std::vector<uint32_t> beginOfBand_; // into candidatesOfBand_
    std::vector<uint32_t> candidatesOfBand_;
    double outside_ = 0.0;
    std::map<uint32_t, double> outsideOf_; // by mesh
};

PageRaster::PageRaster(const Scan& scan, const Facets& facets, uint32_t page)
    : scan_(scan),
      facets_(facets), size_{scan.pages[page].image.width, scan.pages[page].image.height}
{
    collect(page);
    sortIntoBands();
}

void PageRaster::add(const Candidate& candidate)
{
    const auto& corner = candidate.triangle.corner;
    const auto [low, high] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const RowRange rows = rowsOf(candidate.triangle, size_.height);
    if (high < 0.0 || low > size_.width - 1.0 || rows.begin >= rows.end) return;
    candidates_.push_back(candidate);
    candidates_.back().rows = rows;
}

/// Tiles far beyond the page are left out: what reaches there is counted, and refused as a rule.
void PageRaster::addCopies(const Candidate& candidate, const Mesh& mesh)
{
    constexpr int kReach = 2; // tiles
    const glm::dvec2 size(size_.width, size_.height);
    const Wrap wraps[2] = {mesh.wrapU, mesh.wrapV};
    for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
            if (i == 0 && j == 0) continue;
            Candidate copy = candidate;
            copy.isCopy = true;
            bool isShown = true;
            for (int axis = 0; axis < 2; ++axis) {
                const int tile = axis == 0 ? i : j;
                isShown = isShown && (tile == 0 || wraps[axis] != Wrap::clamp);
                for (glm::dvec2& corner : copy.triangle.corner) {
                    corner[axis] -= tile * size[axis];
                    if (wraps[axis] == Wrap::mirror && tile % 2 != 0)
                        corner[axis] = size[axis] - 1.0 - corner[axis];
                }
            }
            if (isShown) add(copy);
        }
}

void PageRaster::collect(uint32_t page)
{
    for (uint32_t m = 0; m < scan_.meshes.size(); ++m) {
        const Mesh& mesh = scan_.meshes[m];
        if (mesh.page != static_cast<int>(page)) continue;
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto facet = static_cast<uint32_t>(facets_.firstOfMesh[m] + i);
            if (facets_.facets[facet].texelArea <= 0.0f) continue;
            const Candidate candidate{.facet = facet,
                                      .triangle = pixelTriangle(scan_, mesh, mesh.triangles[i]),
                                      .rows = {},
                                      .tile = tileOf(mesh, mesh.triangles[i])};
            add(candidate);
            const double outside = areaOutside(candidate.triangle, size_);
            if (outside <= 0.0) continue;
            outside_ += outside;
            outsideOf_[m] += outside;
            addCopies(candidate, mesh);
        }
    }
}

void PageRaster::sortIntoBands()
{
    const auto bands = static_cast<size_t>((size_.height + kRowsOfBand - 1) / kRowsOfBand);
    beginOfBand_.assign(bands + 1, 0);
    const auto forEachBand = [&](auto&& visit) {
        for (uint32_t i = 0; i < candidates_.size(); ++i) {
            const RowRange& rows = candidates_[i].rows;
            for (int band = rows.begin / kRowsOfBand; band <= (rows.end - 1) / kRowsOfBand; ++band)
                visit(static_cast<size_t>(band), i);
        }
    };
    forEachBand([&](size_t band, uint32_t) { ++beginOfBand_[band + 1]; });
    std::partial_sum(beginOfBand_.begin(), beginOfBand_.end(), beginOfBand_.begin());
    candidatesOfBand_.resize(beginOfBand_.back());
    std::vector<uint32_t> next(beginOfBand_.begin(), beginOfBand_.end() - 1);
    forEachBand([&](size_t band, uint32_t i) { candidatesOfBand_[next[band]++] = i; });
}

/// A second facet wants the inside of a texel.
void PageRaster::contest(uint32_t index, glm::ivec2 pixel, size_t at, Band& band,
                         PageCoverage& coverage) const
{
    const Candidate& owner = candidates_[band.owner[at]];
    const Candidate& other = candidates_[index];
    const Facet& ofOwner = facets_.facets[owner.facet];
    const Facet& ofOther = facets_.facets[other.facet];
    const OverlapKind kind = overlapKindOf(ofOwner, ofOther, pixel, owner.tile == other.tile);
    if (band.kinds[at] % kRepeated == 0) {
        const uint32_t mesh = facets_.meshOf[owner.facet];
        const uint32_t otherMesh = facets_.meshOf[other.facet];
        coverage.inMesh[mesh] += 1.0;
        if (otherMesh != mesh) coverage.inMesh[otherMesh] += 1.0;
    }
    band.kinds[at] = static_cast<uint8_t>(band.kinds[at] | 1u << static_cast<unsigned>(kind));
    if (kind != OverlapKind::alike) return;
    uint32_t& front = band.front.try_emplace(at, band.owner[at]).first->second;
    if (isBefore(facets_.facets[candidates_[front].facet], ofOther, pixel)) front = index;
}

void PageRaster::drawFacet(uint32_t index, RowRange rows, Band& band, PageCoverage& coverage) const
{
    const Candidate& candidate = candidates_[index];
    const EdgeTriangle edges(candidate.triangle);
    for (int y = rows.begin; y < rows.end; ++y) {
        const Row row = edges.row(y, 0.0);
        const RowRange columns = columnsOf(row, size_.width);
        const Row inner = edges.row(y, kInside);
        const size_t first =
            static_cast<size_t>(y - band.firstRow) * static_cast<size_t>(size_.width);
        for (int x = columns.begin; x < columns.end; ++x) {
            const size_t at = first + static_cast<size_t>(x);
            const bool isInside = x >= inner.begin && x <= inner.end;
            if (candidate.isCopy)
                band.kinds[at] |= isInside ? kRepeated : uint8_t{0};
            else if (band.owner[at] == kNobody)
                band.owner[at] = index;
            else if (isInside)
                contest(index, {x, y}, at, band, coverage);
        }
    }
}

void PageRaster::drawBand(int index, PageCoverage& coverage) const
{
    const int firstRow = index * kRowsOfBand;
    const int endRow = std::min(firstRow + kRowsOfBand, size_.height);
    const auto width = static_cast<size_t>(size_.width);
    const size_t pixels = width * static_cast<size_t>(endRow - firstRow);
    Band band{firstRow, std::vector<uint32_t>(pixels, kNobody), std::vector<uint8_t>(pixels), {}};
    for (uint32_t i = beginOfBand_[static_cast<size_t>(index)];
         i < beginOfBand_[static_cast<size_t>(index) + 1]; ++i) {
        const RowRange& rows = candidates_[candidatesOfBand_[i]].rows;
        drawFacet(candidatesOfBand_[i],
                  {std::max(rows.begin, firstRow), std::min(rows.end, endRow)}, band, coverage);
    }
    for (const auto& [at, front] : band.front)
        coverage.inFront.emplace_back(
            static_cast<uint32_t>(static_cast<size_t>(firstRow) * width + at),
            candidates_[front].facet);
    const size_t covered =
        pixels - static_cast<size_t>(std::count(band.owner.begin(), band.owner.end(), kNobody));
    coverage.pixel.reserve(covered);
    coverage.facet.reserve(covered);
    for (size_t i = 0; i < pixels; ++i) {
        if (band.owner[i] == kNobody) continue;
        const auto pixel = static_cast<uint32_t>(static_cast<size_t>(firstRow) * width + i);
        coverage.pixel.push_back(pixel);
        coverage.facet.push_back(candidates_[band.owner[i]].facet);
        if (const unsigned kinds = band.kinds[i]; kinds >= kRepeated)
            coverage.shared.push_back({pixel, OverlapKind::tiled, kinds > kRepeated});
        else if (kinds != 0)
            coverage.shared.push_back(
                {pixel, static_cast<OverlapKind>(std::bit_width(kinds) - 1), true});
    }
}

PageCoverage PageRaster::run()
{
    std::vector<PageCoverage> bands(beginOfBand_.size() - 1);
    forEach(bands.size(), [&](size_t band) { drawBand(static_cast<int>(band), bands[band]); });

    PageCoverage whole;
    whole.outside = outside_;
    whole.inMesh = outsideOf_;
    size_t count = 0;
    for (const PageCoverage& band : bands) count += band.pixel.size();
    whole.pixel.reserve(count);
    whole.facet.reserve(count);
    for (PageCoverage& band : bands) {
        whole.pixel.insert(whole.pixel.end(), band.pixel.begin(), band.pixel.end());
        whole.facet.insert(whole.facet.end(), band.facet.begin(), band.facet.end());
        whole.shared.insert(whole.shared.end(), band.shared.begin(), band.shared.end());
        whole.inFront.insert(whole.inFront.end(), band.inFront.begin(), band.inFront.end());
        for (const auto& [mesh, texels] : band.inMesh) whole.inMesh[mesh] += texels;
        band = {};
    }
    if (!whole.isOfSeamsAlone()) whole.showFronts();
    return whole;
}

PageCoverage coverageOfVertices(const Scan& scan, const Facets& facets)
{
    PageCoverage coverage;
    for (const Mesh& mesh : scan.meshes) {
        if (!scan.pages[static_cast<size_t>(mesh.page)].ofVertices) continue;
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            const auto pixel = static_cast<uint32_t>(mesh.firstPixel + i);
            const auto facet = static_cast<uint32_t>(facets.triangles + pixel);
            if (facets.facets[facet].texelArea <= 0.0f) continue; // no triangle uses it
            coverage.pixel.push_back(pixel);
            coverage.facet.push_back(facet);
        }
    }
    return coverage;
}

} // namespace

bool PageCoverage::isOfSeamsAlone() const
{
    return static_cast<double>(shared.size()) <= kSeams * static_cast<double>(pixel.size());
}

void PageCoverage::showFronts()
{
    for (const auto& [where, front] : inFront)
        facet[static_cast<size_t>(std::lower_bound(pixel.begin(), pixel.end(), where) -
                                  pixel.begin())] = front;
}

PageCoverage rasterizePage(const Scan& scan, const Facets& facets, uint32_t page)
{
    return scan.pages[page].ofVertices ? coverageOfVertices(scan, facets)
                                       : PageRaster(scan, facets, page).run();
}

} // namespace relamp
