#include "thesis/flatten.h"

#include "base/lanes.h"
#include "base/parallel.h"
#include "thesis/flatten.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace relamp
{
namespace
{

constexpr size_t kBins = kFlattenBins;

/// Mean colour of the texels of one surfel that are about equally bright.
struct Cell
{
    glm::vec3 color{0.0f}; // square root of radiance; a sum until the grid is finished
    float area = 0.0f;
};

/// Samples that the texels of one surfel are filtered over, as structure of arrays.
struct Taps
{
    static constexpr size_t kMost = 1024; // far more than a surface has; what is beyond is left out

    float x[kMost], y[kMost], z[kMost];
    float r[kMost], g[kMost], b[kMost];
    float weight[kMost];
    size_t count = 0;

    void clear() { count = 0; }
    void add(glm::vec3 position, glm::vec3 color, float tapWeight)
    {
        if (count == kMost) return;
        x[count] = position.x;
        y[count] = position.y;
        z[count] = position.z;
        r[count] = color.r;
        g[count] = color.g;
        b[count] = color.b;
        weight[count++] = tapWeight;
    }
};

struct Scales
{
    float perReachSquared;
    float perRangeSquared;
};

/// Texels of a block, from `first` on, that are filtered over the same taps.
struct Part
{
    size_t first;
    size_t end;
};

/// Filtered colours (square roots of radiance) of one part of a block. Entries of `out` up to a
/// whole group of lanes behind it are overwritten, so parts are worked on in order.
void filterKernel(const TexelBlock& block, const Part& part, const Taps& taps, const Scales& scales,
                  RgbBlock& out)
{
    const size_t tapCount = taps.count;
    for (size_t first = part.first; first < part.end; first += kLanes) {
        float r[kLanes] = {};
        float g[kLanes] = {};
        float b[kLanes] = {};
        float sum[kLanes] = {};
        for (size_t t = 0; t < tapCount; ++t) {
            const glm::vec3 position(taps.x[t], taps.y[t], taps.z[t]);
            const glm::vec3 color(taps.r[t], taps.g[t], taps.b[t]);
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way = position - glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 step = color - glm::vec3(block.r[i], block.g[i], block.b[i]);
                const float w = taps.weight[t] * bilateralWeight(way, step, scales.perReachSquared,
                                                                 scales.perRangeSquared);
                r[lane] += w * color.r;
                g[lane] += w * color.g;
                b[lane] += w * color.b;
                sum[lane] += w;
            }
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const size_t i = first + lane;
            const bool found = sum[lane] > 1e-12f; // else nothing near has its colour: it stays
            const float scale = 1.0f / (found ? sum[lane] : 1.0f);
            out.r[i] = found ? r[lane] * scale : block.r[i];
            out.g[i] = found ? g[lane] * scale : block.g[i];
            out.b[i] = found ? b[lane] * scale : block.b[i];
        }
    }
}

void rootKernel(TexelBlock& block)
{
    for (size_t i = 0; i < block.count; ++i) {
        block.r[i] = std::sqrt(std::min(block.r[i], 1.0f));
        block.g[i] = std::sqrt(std::min(block.g[i], 1.0f));
        block.b[i] = std::sqrt(std::min(block.b[i], 1.0f));
    }
}

using Bins = std::array<int32_t, TexelBlock::kCapacity>;

/// Square roots of radiance times area, and their bins.
void weighKernel(TexelBlock& block, Bins& bins)
{
    rootKernel(block);
    for (size_t i = 0; i < block.count; ++i) {
        bins[i] = brightnessBin({block.r[i], block.g[i], block.b[i]});
        block.r[i] *= block.area[i];
        block.g[i] *= block.area[i];
        block.b[i] *= block.area[i];
    }
}

/// The cells of all surfels that hold anything, those of one surfel together.
struct Grid
{
    std::vector<Cell> cells;
    std::vector<uint32_t> firstOfSurfel; // one more than there are surfels
};

using CellsOfSurfel = std::array<Cell, kBins>;

Grid compact(const std::vector<CellsOfSurfel>& sums)
{
    Grid grid;
    grid.firstOfSurfel.assign(sums.size() + 1, 0);
    const auto isFilled = [](const Cell& cell) { return cell.area > 0.0f; };
    forEachChunk(sums.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            grid.firstOfSurfel[s + 1] =
                static_cast<uint32_t>(std::count_if(sums[s].begin(), sums[s].end(), isFilled));
    });
    std::partial_sum(grid.firstOfSurfel.begin(), grid.firstOfSurfel.end(),
                     grid.firstOfSurfel.begin());
    grid.cells.resize(grid.firstOfSurfel.back());
    forEachChunk(sums.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            size_t at = grid.firstOfSurfel[s];
            for (const Cell& cell : sums[s])
                if (isFilled(cell)) grid.cells[at++] = {cell.color / cell.area, cell.area};
        }
    });
    return grid;
}

/// Adds the texels of a block, of one surfel, to its cells. Neighbours add to cells of their own,
/// for they tend to be in the same bin and one sum would wait for the other.
void addTo(CellsOfSurfel& cells, const TexelBlock& block, const Bins& bins)
{
    std::array<CellsOfSurfel, 2> sums{};
    for (size_t i = 0; i < block.count; ++i) {
        Cell& cell = sums[i % 2][static_cast<size_t>(bins[i])];
        cell.color += glm::vec3(block.r[i], block.g[i], block.b[i]);
        cell.area += block.area[i];
    }
    for (size_t bin = 0; bin < kBins; ++bin) {
        cells[bin].color += sums[0][bin].color + sums[1][bin].color;
        cells[bin].area += sums[0][bin].area + sums[1][bin].area;
    }
}

Grid gatherCells(const Texels& texels, InstructionSet set)
{
    std::vector<CellsOfSurfel> sums(texels.surfels.count());
    for (size_t p = 0; p < texels.pages.size();
         ++p) { // one page after the other: they share surfels
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        forEachRun(page, [&](size_t run, TexelBlock& block) {
            Bins bins;
            forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
                loader.loadRadiance(begin, count, block);
                loader.loadArea(begin, count, block);
                runKernel<weighKernel>(set, block, bins);
                addTo(sums[page.runs[run].surfel], block, bins);
            });
        });
    }
    return compact(sums);
}

void collectTaps(const Surfels& surfels, const Grid& grid, size_t surfel, Taps& taps)
{
    taps.clear();
    for (const uint32_t other : surfels.neighborsOf(surfel)) {
        const float facing = glm::dot(surfels.normal[surfel], surfels.normal[other]);
        for (uint32_t i = grid.firstOfSurfel[other]; i < grid.firstOfSurfel[other + 1]; ++i)
            taps.add(surfels.position[other], grid.cells[i].color,
                     grid.cells[i].area * facing * facing);
    }
}

void store(const RgbBlock& colors, std::span<const uint32_t> pixels, std::vector<uint8_t>& page)
{
    std::array<std::array<uint8_t, TexelBlock::kCapacity>, 3> bytes;
    const std::array<const float*, 3> channels{colors.r, colors.g, colors.b};
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < pixels.size(); ++i)
            bytes[c][i] = static_cast<uint8_t>(static_cast<int>(255.0f * channels[c][i] + 0.5f));
    for (size_t i = 0; i < pixels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) page[3 * size_t{pixels[i]} + c] = bytes[c][i];
}

/// Filters one page into `out`.
void filterPage(const Texels& texels, size_t p, const Grid& grid, const Scales& scales,
                InstructionSet set, std::vector<uint8_t>& out)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p);
    forEachBlock(page, [&](size_t begin, size_t count) {
        TexelBlock block;
        RgbBlock filtered;
        Taps taps;
        loader.load(begin, count, block);
        runKernel<rootKernel>(set, block);
        size_t run = page.runOf(begin);
        for (size_t at = begin; at < begin + count; ++run) {
            const size_t end = std::min<size_t>(begin + count, page.runs[run + 1].begin);
            collectTaps(texels.surfels, grid, page.runs[run].surfel, taps);
            const Part part{at - begin, end - begin};
            runKernel<filterKernel>(set, block, part, taps, scales, filtered);
            at = end;
        }
        store(filtered, {&page.pixel[begin], count}, out);
    });
}

} // namespace

Flattened flatten(const Texels& texels, const FlattenOptions& options, Progress& progress,
                  InstructionSet set)
{
    Progress::Stage stage(progress, "flatten", texels.pages.size() + 1);
    const Grid grid = gatherCells(texels, set);
    stage.advance();
    const float reach = options.reach * texels.surfels.size;
    const Scales scales{1.0f / (reach * reach), 1.0f / (options.range * options.range)};

    Flattened flattened;
    flattened.pages.resize(texels.pages.size());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        flattened.pages[p].resize(3 * texels.scan->pages[p].image.pixels());
        filterPage(texels, p, grid, scales, set, flattened.pages[p]);
        stage.advance();
    }
    return flattened;
}

} // namespace relamp
