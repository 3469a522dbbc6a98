#include "rooms/atlas.h"

#include "base/radiometry.shared.h"
#include "scan/finish_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp::rooms
{
namespace
{

constexpr float kLargestChart = 1.5f; // m
constexpr float kFewestCells = 3.0f;  // across a sixth of a sphere
constexpr float kSparsest = 10.0f;    // pixels a metre that a search begins and ends with
constexpr float kDensest = 2000.0f;

glm::vec2 sizeOf(const Patch& patch)
{
    if (patch.radius > 0.0f) return glm::vec2(0.5f * kPi * patch.radius);
    return {glm::length(patch.alongU), glm::length(patch.alongV)};
}

/// The same patch lying on its side: u is where v was.
Patch rolled(Patch patch)
{
    const glm::vec3 u = patch.alongU;
    patch.corner += u;
    patch.alongU = patch.alongV;
    patch.alongV = -u;
    return patch;
}

std::vector<Patch> piecesOf(const Patch& whole)
{
    if (whole.radius > 0.0f) return {whole};
    const glm::vec2 count = glm::ceil(sizeOf(whole) / kLargestChart);
    std::vector<Patch> pieces;
    for (float v = 0.0f; v < count.y; ++v)
        for (float u = 0.0f; u < count.x; ++u) {
            Patch piece = whole;
            piece.corner = whole.at(u / count.x, v / count.y);
            piece.alongU = whole.alongU / count.x;
            piece.alongV = whole.alongV / count.y;
            const glm::vec2 size = sizeOf(piece);
            pieces.push_back(size.y > size.x ? rolled(piece) : piece);
        }
    return pieces;
}

/// Puts charts on shelves, the highest first. Whether all found a place.
bool pack(Atlas& atlas, float pixelsPerMetre)
{
    for (Chart& chart : atlas.charts)
        chart.pixels = glm::max(glm::ivec2(glm::round(pixelsPerMetre * sizeOf(chart.patch))), 1);
    std::vector<size_t> order(atlas.charts.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return atlas.charts[a].pixels.y > atlas.charts[b].pixels.y;
    });
    glm::ivec2 next(kPadding);
    int shelf = 0; // its height
    for (const size_t i : order) {
        Chart& chart = atlas.charts[i];
        if (next.x + chart.pixels.x + kPadding > atlas.side) {
            next = {kPadding, next.y + shelf + kPadding};
            shelf = 0;
        }
        shelf = std::max(shelf, chart.pixels.y);
        chart.corner = next;
        if (next.x + chart.pixels.x + kPadding > atlas.side ||
            next.y + chart.pixels.y + kPadding > atlas.side)
            return false;
        next.x += chart.pixels.x + kPadding;
    }
    return true;
}

void addChart(Mesh& mesh, const Chart& chart, float side, glm::ivec2 cells)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int j = 0; j <= cells.y; ++j)
        for (int i = 0; i <= cells.x; ++i) {
            const glm::vec2 at = glm::vec2(i, j) / glm::vec2(cells);
            mesh.positions.push_back(chart.patch.at(at.x, at.y));
            mesh.uvs.push_back((glm::vec2(chart.corner) + at * glm::vec2(chart.pixels)) / side);
        }
    const auto row = static_cast<uint32_t>(cells.x) + 1;
    for (uint32_t j = 0; j < static_cast<uint32_t>(cells.y); ++j)
        for (uint32_t i = 0; i + 1 < row; ++i) {
            const uint32_t corner = first + j * row + i;
            mesh.triangles.emplace_back(corner, corner + 1, corner + row);
            mesh.triangles.emplace_back(corner + 1, corner + row + 1, corner + row);
        }
}

} // namespace

Atlas layOut(const Room& room, int side)
{
    Atlas atlas{.side = side};
    for (const Patch& patch : room.patches)
        for (const Patch& piece : piecesOf(patch)) atlas.charts.push_back({.patch = piece});
    float fits = kSparsest;
    float fitsNot = kDensest;
    while (fitsNot > 1.005f * fits) {
        const float middle = std::sqrt(fits * fitsNot);
        (pack(atlas, middle) ? fits : fitsNot) = middle;
    }
    pack(atlas, fits);
    return atlas;
}

ChartMesh meshOf(const Atlas& atlas, float cell)
{
    ChartMesh result;
    Mesh mesh;
    mesh.name = "room";
    mesh.page = 0;
    for (size_t i = 0; i < atlas.charts.size(); ++i) {
        const Chart& chart = atlas.charts[i];
        const float fewest = chart.patch.radius > 0.0f ? kFewestCells : 1.0f;
        const glm::ivec2 cells(glm::max(glm::round(sizeOf(chart.patch) / cell), glm::vec2(fewest)));
        addChart(mesh, chart, static_cast<float>(atlas.side), cells);
        result.chartOf.resize(mesh.triangles.size(), static_cast<uint32_t>(i));
    }
    finishMesh(mesh, {}, "room", result.scan.warnings);
    Page page;
    page.name = "scan";
    page.image.width = atlas.side;
    page.image.height = atlas.side;
    page.image.rgb = std::vector<uint8_t>(3 * page.image.pixels(), 255);
    result.scan.name = "room";
    result.scan.meshes.push_back(std::move(mesh));
    result.scan.pages.push_back(std::move(page));
    return result;
}

} // namespace relamp::rooms
