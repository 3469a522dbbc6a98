#include "scan/charts.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace relamp
{
namespace
{

/// A vertex of the scan, all meshes in a row, and where it lies on its page.
struct ChartCorner
{
    int page;
    float u;
    float v;
    uint32_t vertex;

    [[nodiscard]] auto place() const { return std::tie(page, u, v); }
};

std::vector<uint32_t> firstVertexOfMesh(const Scan& scan)
{
    std::vector<uint32_t> first{0};
    for (const Mesh& mesh : scan.meshes)
        first.push_back(first.back() + static_cast<uint32_t>(mesh.positions.size()));
    return first;
}

void joinVerticesOfOnePlace(const Scan& scan, const std::vector<uint32_t>& firstVertex,
                            DisjointSets& charts)
{
    std::vector<ChartCorner> corners;
    for (size_t m = 0; m < scan.meshes.size(); ++m) {
        const Mesh& mesh = scan.meshes[m];
        for (size_t i = 0; i < mesh.uvs.size(); ++i)
            corners.push_back({mesh.page, mesh.uvs[i].x, mesh.uvs[i].y,
                               firstVertex[m] + static_cast<uint32_t>(i)});
    }
    std::sort(corners.begin(), corners.end(), [](const ChartCorner& a, const ChartCorner& b) {
        return std::tuple_cat(a.place(), std::tie(a.vertex)) <
               std::tuple_cat(b.place(), std::tie(b.vertex));
    });
    for (size_t i = 1; i < corners.size(); ++i)
        if (corners[i].place() == corners[i - 1].place())
            charts.join(corners[i].vertex, corners[i - 1].vertex);
}

} // namespace

std::vector<uint32_t> chartsOfTriangles(const Scan& scan)
{
    const std::vector<uint32_t> firstVertex = firstVertexOfMesh(scan);
    DisjointSets charts(firstVertex.back());
    joinVerticesOfOnePlace(scan, firstVertex, charts);
    for (size_t m = 0; m < scan.meshes.size(); ++m)
        for (const glm::uvec3& t : scan.meshes[m].triangles) {
            charts.join(firstVertex[m] + t.x, firstVertex[m] + t.y);
            charts.join(firstVertex[m] + t.x, firstVertex[m] + t.z);
        }
    std::vector<uint32_t> chartOfRoot(firstVertex.back(), kNoChart);
    std::vector<uint32_t> chartOf(scan.triangleCount(), kNoChart);
    uint32_t count = 0;
    for (size_t page = 0; page < scan.pages.size(); ++page)
        for (size_t m = 0, at = 0; m < scan.meshes.size();
             at += scan.meshes[m++].triangles.size()) {
            const Mesh& mesh = scan.meshes[m];
            if (static_cast<size_t>(mesh.page) != page || mesh.uvs.empty()) continue;
            for (size_t i = 0; i < mesh.triangles.size(); ++i) {
                uint32_t& chart = chartOfRoot[charts.find(firstVertex[m] + mesh.triangles[i].x)];
                if (chart == kNoChart) chart = count++;
                chartOf[at + i] = chart;
            }
        }
    return chartOf;
}

Charts::Charts(const Texels& texels) : ofPixel_(texels.pages.size())
{
    constexpr uint32_t kMarks = std::numeric_limits<Mark>::max();
    for (const uint32_t chart : chartsOfTriangles(*texels.scan))
        ofTriangle_.push_back(chart == kNoChart ? Mark{0} : static_cast<Mark>(chart % kMarks + 1));
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const Page& page = texels.scan->pages[p];
        if (page.ofVertices) continue; // nothing lies between its pixels but triangles
        ofPixel_[p].resize(page.image.pixels());
        const PageTexels& covered = texels.pages[p];
        forEachChunk(covered.count(), 65536, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                ofPixel_[p][covered.pixel[i]] = ofTriangle_[covered.facet[i]];
        });
    }
}

void Charts::keepToChart(uint32_t triangle, PixelMix& mix) const
{
    const std::vector<Mark>& ofPixel = ofPixel_[mix.page];
    if (ofPixel.empty()) return;
    std::array<float, 4> kept{};
    float sum = 0.0f;
    for (size_t k = 0; k < 4; ++k)
        if (ofPixel[mix.pixel[k]] == ofTriangle_[triangle]) sum += kept[k] = mix.weight[k];
    if (!(sum > 1e-4f)) return;
    for (size_t k = 0; k < 4; ++k) mix.weight[k] = kept[k] / sum;
}

} // namespace relamp
