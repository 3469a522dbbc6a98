#include "lights/surfel_radiance.h"

#include "image/burnt_out.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

struct RadianceSum
{
    glm::vec3 plain{0.0f};
    float plainArea = 0.0f;
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec3 clipped{0.0f};
    float clippedArea = 0.0f;
};

/// The way that the surface of a texel faces. Where noise was taken off the normals, they lean
/// across the edge between a lamp and its wall.
glm::vec3 facingOf(const Texels& texels, uint32_t facet, glm::vec3 normal)
{
    const Facets& facets = texels.facets;
    const uint32_t m = facets.meshOf[facet];
    const std::vector<glm::vec3>& facings = texels.scan->meshes[m].facings;
    if (facings.empty() || facet >= facets.triangles) return normal;
    return facings[facet - facets.firstOfMesh[m]];
}

void addPlain(const TexelBlock& block, size_t i, RadianceSum& sum)
{
    sum.plain += block.area[i] * glm::vec3(block.r[i], block.g[i], block.b[i]);
    sum.plainArea += block.area[i];
}

void addClipped(const TexelBlock& block, size_t i, glm::vec3 facing, RadianceSum& sum)
{
    const float area = block.area[i];
    sum.position += area * glm::vec3(block.x[i], block.y[i], block.z[i]);
    sum.normal += area * facing;
    sum.clipped += area * glm::vec3(block.r[i], block.g[i], block.b[i]);
    sum.clippedArea += area;
}

/// Sums of all runs of one page; marks its clipped pixels. `isBurntOut(pixel, shown)` says which
/// they are, by what the texture shows.
template<class IsBurntOut>
std::vector<RadianceSum> sumRuns(const Texels& texels, size_t p, const Linearization* linearization,
                                 const IsBurntOut& isBurntOut, std::vector<bool>& isClipped)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p, linearization);
    std::vector<RadianceSum> sums(page.runs.size() - 1);
    std::vector<uint8_t> clipped(texels.scan->pages[p].image.pixels(), 0);
    forEachRun(page, [&](size_t run, TexelBlock& block) {
        const glm::vec3 white = linearization == nullptr
                                    ? glm::vec3(1.0f)
                                    : linearization->whiteOf(page.runs[run].surfel);
        forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
            loader.load(begin, count, block);
            loader.loadArea(begin, count, block);
            for (size_t i = 0; i < count; ++i) {
                const glm::vec3 radiance(block.r[i], block.g[i], block.b[i]);
                if (!isBurntOut(page.pixel[begin + i], radiance / white)) {
                    addPlain(block, i, sums[run]);
                    continue;
                }
                clipped[page.pixel[begin + i]] = 1;
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                addClipped(block, i, facingOf(texels, page.facet[begin + i], normal), sums[run]);
            }
        });
    });
    isClipped = marksFrom(clipped);
    return sums;
}

std::vector<RadianceSum> sumRunsByTexture(const Texels& texels, size_t p,
                                          const Linearization* linearization,
                                          std::vector<bool>& isClipped)
{
    const float burntOut = texels.scan->pages[p].image.clipsAtWhite ? kBurntOut : 1.0f;
    return sumRuns(
        texels, p, linearization,
        [&](uint32_t, glm::vec3 shown) { return brightestChannel(shown) >= burntOut; }, isClipped);
}

} // namespace

SurfelRadiance collectRadiance(const Texels& texels, Progress& progress,
                               std::span<const std::vector<bool>> isBurntOut,
                               const Linearization* linearization)
{
    const size_t surfels = texels.surfels.count();
    std::vector<RadianceSum> total(surfels);
    SurfelRadiance result;
    if (linearization != nullptr) result.white = linearization->perGain;
    result.isClipped.resize(texels.pages.size());
    Progress::Stage stage(progress, "lights", texels.pages.size());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const std::vector<RadianceSum> sums =
            isBurntOut.empty()
                ? sumRunsByTexture(texels, p, linearization, result.isClipped[p])
                : sumRuns(
                      texels, p, linearization,
                      [&](uint32_t pixel, glm::vec3) { return isBurntOut[p][pixel]; },
                      result.isClipped[p]);
        for (size_t run = 0; run < sums.size(); ++run) {
            RadianceSum& sum = total[texels.pages[p].runs[run].surfel];
            sum.plain += sums[run].plain;
            sum.plainArea += sums[run].plainArea;
            sum.position += sums[run].position;
            sum.normal += sums[run].normal;
            sum.clipped += sums[run].clipped;
            sum.clippedArea += sums[run].clippedArea;
        }
        stage.advance();
    }
    result.plain.assign(surfels, glm::vec3(1.0f));
    result.plainArea.resize(surfels);
    result.clippedArea.resize(surfels);
    for (uint32_t s = 0; s < surfels; ++s) {
        const RadianceSum& sum = total[s];
        result.plainArea[s] = sum.plainArea;
        result.clippedArea[s] = sum.clippedArea;
        if (sum.plainArea > 0.0f) result.plain[s] = sum.plain / sum.plainArea;
        if (sum.clippedArea <= 0.0f) continue;
        const float length = glm::length(sum.normal);
        result.clipped.push_back({sum.position / sum.clippedArea,
                                  length > 0.0f ? sum.normal / length : texels.surfels.normal[s],
                                  sum.clippedArea, s, sum.clipped / sum.clippedArea});
    }
    return result;
}

} // namespace relamp
