#include "relamp/inspect.h"

#include "image/burnt_out.shared.h"
#include "relamp/printable.h"
#include "scan/charts.h"
#include "scan/inside_out.h"
#include "scan/overlap.h"
#include "scan/texels.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr double kMuchClipped = 0.25;
constexpr double kFewTexels = 0.10;
constexpr float kSmallestRoom = 1.0f; // m
constexpr float kLargestRoom = 100.0f;

double clippedShare(const Texels& texels, size_t page)
{
    const TexelLoader loader(texels, page);
    const bool clips = texels.scan->pages[page].image.clipsAtWhite;
    const size_t count = texels.pages[page].count();
    std::vector<size_t> clipped(count / TexelBlock::kCapacity + 1, 0);
    forEachBlock(texels.pages[page], [&](size_t begin, size_t blockCount) {
        TexelBlock block;
        loader.loadRadiance(begin, blockCount, block);
        size_t& sum = clipped[begin / TexelBlock::kCapacity];
        for (size_t i = 0; i < blockCount; ++i)
            sum += isBurntOut({block.r[i], block.g[i], block.b[i]}, clips) ? size_t{1} : size_t{0};
    });
    size_t sum = 0;
    for (const size_t c : clipped) sum += c;
    return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0.0;
}

/// How many charts each page has.
std::vector<size_t> countCharts(const Scan& scan)
{
    const std::vector<uint32_t> chartOf = chartsOfTriangles(scan);
    std::vector<std::set<uint32_t>> charts(scan.pages.size());
    size_t triangle = 0;
    for (const Mesh& mesh : scan.meshes)
        for (size_t i = 0; i < mesh.triangles.size(); ++i, ++triangle)
            if (chartOf[triangle] != kNoChart)
                charts[static_cast<size_t>(mesh.page)].insert(chartOf[triangle]);
    std::vector<size_t> counts;
    counts.reserve(charts.size());
    for (const auto& ofPage : charts) counts.push_back(ofPage.size());
    return counts;
}

PageInspection inspectPage(const Scan& scan, const Texels& texels, size_t index)
{
    const Page& page = scan.pages[index];
    PageInspection result{.name = page.name,
                          .width = page.image.width,
                          .height = page.image.height,
                          .ofVertices = page.ofVertices};
    result.coverage =
        static_cast<double>(texels.pages[index].count()) / static_cast<double>(page.image.pixels());
    result.clipped = clippedShare(texels, index);
    return result;
}

void findProblems(const Scan& scan, Inspection& result)
{
    auto& problems = result.problems;
    const glm::vec3 extent = result.bounds.extent();
    const float largest = std::max({extent.x, extent.y, extent.z});
    if (auto note = noteOn(result.overlap)) problems.push_back(std::move(*note));
    if (largest < kSmallestRoom || largest > kLargestRoom)
        problems.push_back(
            fmt::format("it is {:.2f} m long, hardly a room. If its unit is not the metre, say so "
                        "with --scale (0.01 for centimetres)",
                        largest));
    if (extent.y > 1.2f * std::max(extent.x, extent.z))
        problems.emplace_back("it is taller than wide. If z points up in it, say --up z");
    double clipped = 0.0;
    for (const PageInspection& page : result.pages) {
        clipped = std::max(clipped, page.clipped);
        if (!page.ofVertices && page.coverage < kFewTexels)
            problems.push_back(
                fmt::format("only {:.0f} % of texture \"{}\" shows a surface; the rest of the "
                            "texture is wasted",
                            100.0 * page.coverage, printableName(page.name)));
    }
    if (clipped > kMuchClipped)
        problems.push_back(fmt::format(
            "{:.0f} % of a texture is burnt out. Albedo cannot be recovered there; scan with "
            "a shorter exposure",
            100.0 * clipped));
    const auto clips = [](const Page& page) { return page.image.clipsAtWhite; };
    if (clipped == 0.0 && std::any_of(scan.pages.begin(), scan.pages.end(), clips))
        problems.emplace_back(
            "nothing is burnt out, so no lamp or window shows itself. Name the lights with "
            "--lights");
}

} // namespace

Inspection inspect(const Scan& scan, Progress& progress)
{
    const Texels texels = rasterizeAtlas(scan, progress);
    Progress::Stage stage(progress, "inspect", scan.pages.size());
    Inspection result;
    result.triangles = scan.triangleCount();
    result.meshes = scan.meshes.size();
    result.texels = texels.count();
    result.squareMetres = texels.area;
    result.millimetresPerTexel = 1e3 * std::sqrt(texels.area / static_cast<double>(texels.count()));
    result.bounds = boundsOf(scan);
    result.overlap = texels.overlap;
    const std::vector<size_t> charts = countCharts(scan);
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        result.pages.push_back(inspectPage(scan, texels, p));
        result.pages.back().charts = charts[p];
        stage.advance();
    }
    result.problems = scan.warnings;
    findProblems(scan, result);
    if (auto note = noteOnFacing(texels.surfels, RayScene(scan)))
        result.problems.push_back(std::move(*note));
    return result;
}

} // namespace relamp
