#include "flatten/flatten.h"

#include "base/lanes.h"
#include "flatten/flatten.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr size_t kBins = 8; // of brightness, in equal steps of its square root

size_t binOf(glm::vec3 root)
{
    const float brightness = 0.25f * root.r + 0.5f * root.g + 0.25f * root.b;
    return static_cast<size_t>(std::clamp(brightness * static_cast<float>(kBins), 0.0f, kBins - 1.0f));
}

/// Mean colour of the texels of one surfel that are about equally bright.
struct Cell
{
    glm::vec3 color{0.0f}; // square root of radiance; a sum until the grid is finished
    float area = 0.0f;
};

/// Samples that the texels of one surfel are filtered over, as structure of arrays.
struct Taps
{
    std::vector<float> x, y, z, r, g, b, weight;

    void clear()
    {
        for (auto* list : {&x, &y, &z, &r, &g, &b, &weight}) list->clear();
    }
    void add(glm::vec3 position, glm::vec3 color, float tapWeight)
    {
        x.push_back(position.x);
        y.push_back(position.y);
        z.push_back(position.z);
        r.push_back(color.r);
        g.push_back(color.g);
        b.push_back(color.b);
        weight.push_back(tapWeight);
    }
    [[nodiscard]] size_t count() const { return x.size(); }
};

struct Scales
{
    float perReachSquared;
    float perRangeSquared;
};

/// Replaces the colours of a block (square roots of radiance) by their filtered values.
void filterKernel(TexelBlock& block, const Taps& taps, const Scales& scales)
{
    const size_t tapCount = taps.count();
    for (size_t first = 0; first < block.count; first += kLanes) {
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
                const float w = taps.weight[t] *
                                bilateralWeight(way, step, scales.perReachSquared, scales.perRangeSquared);
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
            block.r[i] = found ? r[lane] * scale : block.r[i];
            block.g[i] = found ? g[lane] * scale : block.g[i];
            block.b[i] = found ? b[lane] * scale : block.b[i];
        }
    }
}

void takeSquareRoots(TexelBlock& block)
{
    for (size_t i = 0; i < block.count; ++i) {
        block.r[i] = std::sqrt(std::min(block.r[i], 1.0f));
        block.g[i] = std::sqrt(std::min(block.g[i], 1.0f));
        block.b[i] = std::sqrt(std::min(block.b[i], 1.0f));
    }
}

std::vector<Cell> gatherCells(const Texels& texels)
{
    std::vector<Cell> cells(kBins * texels.surfels.count());
    for (size_t p = 0; p < texels.pages.size(); ++p) { // one page after the other: they share surfels
        const TexelLoader loader(texels, p);
        forEachRun(texels.pages[p], [&](size_t run, size_t begin, size_t count) {
            TexelBlock block;
            loader.loadRadiance(begin, count, block);
            takeSquareRoots(block);
            Cell* ofSurfel = &cells[kBins * texels.pages[p].runs[run].surfel];
            for (size_t i = 0; i < count; ++i) {
                const glm::vec3 color(block.r[i], block.g[i], block.b[i]);
                Cell& cell = ofSurfel[binOf(color)];
                cell.color += block.area[i] * color;
                cell.area += block.area[i];
            }
        });
    }
    for (Cell& cell : cells)
        if (cell.area > 0.0f) cell.color /= cell.area;
    return cells;
}

void collectTaps(const Texels& texels, const std::vector<Cell>& cells, size_t surfel, Taps& taps)
{
    const Surfels& surfels = texels.surfels;
    taps.clear();
    for (const uint32_t other : surfels.neighborsOf(surfel)) {
        const float facing = glm::dot(surfels.normal[surfel], surfels.normal[other]);
        for (size_t bin = 0; bin < kBins; ++bin) {
            const Cell& cell = cells[kBins * other + bin];
            if (cell.area > 0.0f)
                taps.add(surfels.position[other], cell.color, cell.area * facing * facing);
        }
    }
}

void store(const TexelBlock& block, const uint32_t* pixel, std::vector<uint8_t>& page)
{
    const auto byte = [](float root) { return static_cast<uint8_t>(255.0f * root + 0.5f); };
    for (size_t i = 0; i < block.count; ++i) {
        uint8_t* rgb = &page[3 * size_t{pixel[i]}];
        rgb[0] = byte(block.r[i]);
        rgb[1] = byte(block.g[i]);
        rgb[2] = byte(block.b[i]);
    }
}

} // namespace

Flattened flatten(const Texels& texels, const FlattenOptions& options, Progress& progress,
                  InstructionSet set)
{
    Progress::Stage stage(progress, "flatten", texels.pages.size() + 1);
    const std::vector<Cell> cells = gatherCells(texels);
    stage.advance();
    const float reach = options.reach * texels.surfels.size;
    const Scales scales{1.0f / (reach * reach), 1.0f / (options.range * options.range)};

    Flattened flattened;
    flattened.pages.resize(texels.pages.size());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        flattened.pages[p].resize(3 * texels.scan->pages[p].image.pixels());
        forEachChunk(page.runs.size() - 1, 64, [&](size_t first, size_t last) {
            Taps taps;
            TexelBlock block;
            for (size_t run = first; run < last; ++run) {
                collectTaps(texels, cells, page.runs[run].surfel, taps);
                forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
                    loader.load(begin, count, block);
                    takeSquareRoots(block);
                    runKernel<filterKernel>(set, block, taps, scales);
                    store(block, &page.pixel[begin], flattened.pages[p]);
                });
            }
        });
        stage.advance();
    }
    return flattened;
}

} // namespace relamp
