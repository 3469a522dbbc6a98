#include "scan/split_surfels.h"

#include "base/parallel.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kGap = 0.32f; // between two layers, in surfel sizes; a rough surface has less
constexpr float kFar = std::numeric_limits<float>::max();
constexpr uint8_t kStays = 1;
constexpr uint8_t kGoes = 2;
constexpr uint8_t kSplit = kStays | kGoes;

/// Calls visit(page, run, end of its texels) for all, those of a page on all threads: no surfel has
/// two runs on a page.
template<class Visit>
void forEachRun(const Texels& texels, const Visit& visit)
{
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const auto& runs = texels.pages[p].runs;
        texels.willNeed(p);
        forEachChunk(runs.size() - 1, 256, [&](size_t begin, size_t end) {
            for (size_t run = begin; run < end; ++run) visit(p, runs[run], runs[run + 1].begin);
        });
        texels.letGo(p);
    }
}

/// Sums up the surfels that are marked.
void sumSurfels(Texels& texels, std::span<const uint8_t> isWanted)
{
    Surfels& surfels = texels.surfels;
    for (size_t s = 0; s < surfels.count(); ++s) {
        if (isWanted[s] == 0) continue;
        surfels.position[s] = surfels.normal[s] = glm::vec3(0.0f);
        surfels.area[s] = 0.0f;
    }
    forEachRun(texels, [&](size_t p, const PageTexels::Run& run, uint32_t end) {
        if (isWanted[run.surfel] == 0) return;
        glm::dvec3 position(0.0);
        glm::vec3 normal(0.0f);
        double area = 0.0;
        for (uint32_t i = run.begin; i < end; ++i) {
            const float texel = texels.facets.facets[texels.pages[p].facet[i]].texelArea;
            const TexelSite site = texels.siteOf(p, i);
            position += static_cast<double>(texel) * glm::dvec3(site.position);
            normal += texel * site.normal;
            area += static_cast<double>(texel);
        }
        surfels.position[run.surfel] += glm::vec3(position);
        surfels.normal[run.surfel] += normal;
        surfels.area[run.surfel] += static_cast<float>(area);
    });
    for (size_t s = 0; s < surfels.count(); ++s) {
        if (isWanted[s] == 0) continue;
        surfels.position[s] /= std::max(surfels.area[s], 1e-20f);
        const float length = glm::length(surfels.normal[s]);
        surfels.normal[s] =
            length > 0.0f ? surfels.normal[s] / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

/// Brings the marked texels of a run behind the others; where they begin.
uint32_t sortRun(PageTexels& page, const std::vector<uint8_t>& marks, uint32_t begin, uint32_t end)
{
    std::vector<std::pair<uint32_t, uint32_t>> marked;
    uint32_t to = begin;
    for (uint32_t i = begin; i < end; ++i) {
        if (marks[i] != 0) {
            marked.emplace_back(page.pixel[i], page.facet[i]);
            continue;
        }
        page.pixel[to] = page.pixel[i];
        page.facet[to++] = page.facet[i];
    }
    for (size_t i = 0; i < marked.size(); ++i)
        std::tie(page.pixel[to + i], page.facet[to + i]) = marked[i];
    return to;
}

/// Sorts a page's texels by the surfels that there will be; `first` is the index of each one's
/// first part.
void splitRuns(PageTexels& page, const std::vector<uint8_t>& marks,
               std::span<const uint8_t> partsOf, std::span<const uint32_t> first)
{
    std::vector<uint32_t> middle(page.runs.size() - 1);
    forEachChunk(middle.size(), 256, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            const auto [surfel, from] = page.runs[run];
            if (partsOf[surfel] == kSplit)
                middle[run] = sortRun(page, marks, from, page.runs[run + 1].begin);
        }
    });
    std::vector<PageTexels::Run> runs;
    for (size_t run = 0; run < middle.size(); ++run) {
        const auto [surfel, from] = page.runs[run];
        const bool isSplit = partsOf[surfel] == kSplit;
        if (!isSplit || middle[run] > from) runs.push_back({first[surfel], from});
        if (isSplit && middle[run] < page.runs[run + 1].begin)
            runs.push_back({first[surfel] + 1, middle[run]});
    }
    runs.push_back(page.runs.back());
    page.runs = std::move(runs);
}

/// Height of a texel over the middle of its surfel, m.
float levelOf(const Texels& texels, size_t page, uint32_t texel, uint32_t surfel)
{
    return glm::dot(texels.siteOf(page, texel).position - texels.surfels.position[surfel],
                    texels.surfels.normal[surfel]);
}

/// The middle of the widest gap between levels, if it is as wide as `least`; kFar: there is none.
float cutOf(std::span<float> levels, float least)
{
    std::sort(levels.begin(), levels.end());
    float cut = kFar;
    for (size_t i = 0; i + 1 < levels.size(); ++i) {
        const float gap = levels[i + 1] - levels[i];
        if (gap <= least) continue;
        least = gap;
        cut = levels[i] + 0.5f * gap;
    }
    return cut;
}

/// Where surfels are to be cut, over their middles, m; kFar: nowhere.
std::vector<float> cutsOf(const Texels& texels)
{
    const size_t count = texels.surfels.count();
    const float least = kGap * texels.surfels.size;
    std::vector<float> low(count, kFar);
    std::vector<float> high(count, -kFar);
    forEachRun(texels, [&](size_t p, const PageTexels::Run& run, uint32_t end) {
        for (uint32_t i = run.begin; i < end; ++i) {
            const float level = levelOf(texels, p, i, run.surfel);
            low[run.surfel] = std::min(low[run.surfel], level);
            high[run.surfel] = std::max(high[run.surfel], level);
        }
    });
    std::vector<std::vector<float>> levels(count); // of those that are as thick as that
    forEachRun(texels, [&](size_t p, const PageTexels::Run& run, uint32_t end) {
        for (uint32_t i = run.begin; i < end && high[run.surfel] - low[run.surfel] > least; ++i)
            levels[run.surfel].push_back(levelOf(texels, p, i, run.surfel));
    });
    std::vector<float> cuts(count);
    for (size_t s = 0; s < count; ++s) cuts[s] = cutOf(levels[s], least);
    return cuts;
}

} // namespace

void findNeighbors(Surfels& surfels)
{
    surfels.cells = SurfelCells(surfels.key);
    connectNeighbors(surfels);
}

void sumSurfels(Texels& texels)
{
    const size_t count = texels.surfels.key.size();
    texels.surfels.position.resize(count);
    texels.surfels.normal.resize(count);
    texels.surfels.area.resize(count);
    sumSurfels(texels, std::vector<uint8_t>(count, 1));
}

void splitSurfels(Texels& texels, const TexelMarks& marks, SurfelPart part)
{
    std::vector<uint8_t> partsOf(texels.surfels.count(), 0);
    forEachRun(texels, [&](size_t p, const PageTexels::Run& run, uint32_t end) {
        for (uint32_t i = run.begin; i < end; ++i)
            partsOf[run.surfel] |= marks[p][i] != 0 ? kGoes : kStays;
    });
    const Surfels before = std::move(texels.surfels);
    Surfels& surfels =
        texels.surfels = {.size = before.size, .seed = before.seed, .grid = before.grid};
    std::vector<uint32_t> first(partsOf.size());
    std::vector<uint8_t> isNew;
    for (size_t s = 0; s < partsOf.size(); ++s) {
        first[s] = static_cast<uint32_t>(surfels.key.size());
        for (const uint8_t which : {kStays, kGoes}) {
            if ((partsOf[s] & which) == 0) continue;
            surfels.key.push_back(before.key[s] |
                                  (which == kGoes ? static_cast<uint64_t>(part) : 0u));
            surfels.position.push_back(before.position[s]);
            surfels.normal.push_back(before.normal[s]);
            surfels.area.push_back(before.area[s]);
            isNew.push_back(partsOf[s] == kSplit ? 1 : 0);
        }
    }
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        splitRuns(texels.pages[p], marks[p], partsOf, first);
        if (texels.isLarge) spillTexels(texels.pages[p]);
        texels.letGo(p);
    }
    sumSurfels(texels, isNew);
}

void separateLayers(Texels& texels)
{
    const std::vector<float> cuts = cutsOf(texels);
    if (std::all_of(cuts.begin(), cuts.end(), [](float cut) { return cut == kFar; })) return;
    TexelMarks isUpper;
    for (const PageTexels& page : texels.pages) isUpper.emplace_back(page.count(), uint8_t{0});
    forEachRun(texels, [&](size_t p, const PageTexels::Run& run, uint32_t end) {
        if (cuts[run.surfel] == kFar) return;
        for (uint32_t i = run.begin; i < end; ++i)
            isUpper[p][i] = levelOf(texels, p, i, run.surfel) > cuts[run.surfel] ? 1 : 0;
    });
    splitSurfels(texels, isUpper, SurfelPart::upper);
}

} // namespace relamp
