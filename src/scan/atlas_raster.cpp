#include "scan/atlas_raster.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relamp
{
namespace
{

constexpr uint32_t kNobody = ~0u;
constexpr int kRowsOfBand = 32;
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
    };

    void collect(const Facets& facets, uint32_t page);
    void sortIntoBands();
    void drawBand(int band, PageCoverage& coverage) const;
    void drawFacet(const Candidate& candidate, RowRange rows, std::vector<uint32_t>& owner,
                   PageCoverage& coverage) const;

    const Scan& scan_;
    PageSize size_;
    std::vector<Candidate> candidates_;
    std::vector<uint32_t> beginOfBand_; // into candidatesOfBand_
    std::vector<uint32_t> candidatesOfBand_;
    double outside_ = 0.0;
};

PageRaster::PageRaster(const Scan& scan, const Facets& facets, uint32_t page)
    : scan_(scan), size_{scan.pages[page].image.width, scan.pages[page].image.height}
{
    collect(facets, page);
    sortIntoBands();
}

void PageRaster::collect(const Facets& facets, uint32_t page)
{
    for (uint32_t m = 0; m < scan_.meshes.size(); ++m) {
        const Mesh& mesh = scan_.meshes[m];
        if (mesh.page != static_cast<int>(page)) continue;
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto facet = static_cast<uint32_t>(facets.firstOfMesh[m] + i);
            if (facets.facets[facet].texelArea <= 0.0f) continue;
            const PixelTriangle triangle = pixelTriangle(scan_, mesh, mesh.triangles[i]);
            outside_ += areaOutside(triangle, size_);
            const RowRange rows = rowsOf(triangle, size_.height);
            if (rows.begin < rows.end) candidates_.push_back({facet, triangle, rows});
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

void PageRaster::drawFacet(const Candidate& candidate, RowRange rows, std::vector<uint32_t>& owner,
                           PageCoverage& coverage) const
{
    const EdgeTriangle edges(candidate.triangle);
    const int firstRow = rows.begin / kRowsOfBand * kRowsOfBand;
    for (int y = rows.begin; y < rows.end; ++y) {
        const Row row = edges.row(y, 0.0);
        const RowRange columns = columnsOf(row, size_.width);
        const Row inner = edges.row(y, kInside);
        uint32_t* pixels =
            owner.data() + static_cast<size_t>(y - firstRow) * static_cast<size_t>(size_.width);
        for (int x = columns.begin; x < columns.end; ++x) {
            if (pixels[x] == kNobody)
                pixels[x] = candidate.facet;
            else if (x >= inner.begin && x <= inner.end)
                ++coverage.contested;
        }
    }
}

void PageRaster::drawBand(int band, PageCoverage& coverage) const
{
    const int firstRow = band * kRowsOfBand;
    const int endRow = std::min(firstRow + kRowsOfBand, size_.height);
    const auto width = static_cast<size_t>(size_.width);
    std::vector<uint32_t> owner(width * static_cast<size_t>(endRow - firstRow), kNobody);
    for (uint32_t i = beginOfBand_[static_cast<size_t>(band)];
         i < beginOfBand_[static_cast<size_t>(band) + 1]; ++i) {
        const Candidate& candidate = candidates_[candidatesOfBand_[i]];
        const RowRange rows{std::max(candidate.rows.begin, firstRow),
                            std::min(candidate.rows.end, endRow)};
        drawFacet(candidate, rows, owner, coverage);
    }
    const size_t covered =
        owner.size() - static_cast<size_t>(std::count(owner.begin(), owner.end(), kNobody));
    coverage.pixel.reserve(covered);
    coverage.facet.reserve(covered);
    for (size_t i = 0; i < owner.size(); ++i) {
        if (owner[i] == kNobody) continue;
        coverage.pixel.push_back(static_cast<uint32_t>(static_cast<size_t>(firstRow) * width + i));
        coverage.facet.push_back(owner[i]);
    }
}

PageCoverage PageRaster::run()
{
    std::vector<PageCoverage> bands(beginOfBand_.size() - 1);
    forEach(bands.size(), [&](size_t band) { drawBand(static_cast<int>(band), bands[band]); });

    PageCoverage whole;
    whole.outside = outside_;
    size_t count = 0;
    for (const PageCoverage& band : bands) count += band.pixel.size();
    whole.pixel.reserve(count);
    whole.facet.reserve(count);
    for (PageCoverage& band : bands) {
        whole.pixel.insert(whole.pixel.end(), band.pixel.begin(), band.pixel.end());
        whole.facet.insert(whole.facet.end(), band.facet.begin(), band.facet.end());
        whole.contested += band.contested;
        band = {};
    }
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

PageCoverage rasterizePage(const Scan& scan, const Facets& facets, uint32_t page)
{
    return scan.pages[page].ofVertices ? coverageOfVertices(scan, facets)
                                       : PageRaster(scan, facets, page).run();
}

} // namespace relamp
