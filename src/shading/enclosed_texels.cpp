#include "shading/enclosed_texels.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "scan/footprints.h"
#include "shading/enclosed_texels.shared.h"
#include "shading/hit_lists.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kRimReach = 2.0f;    // of an enclosed surfel to open ones, in surfel sizes
constexpr float kRimStep = 0.3f;     // off its surface, in these
constexpr float kRimFacing = 0.8f;   // cosine
constexpr float kDark = 1e-4f;       // shading
constexpr size_t kRaysOfSurfel = 12; // that say whether its texels need to be looked at
constexpr size_t kRaysOfTexel = 24;
constexpr size_t kMostOpen = kRaysOfTexel / 4; // rays of an enclosed one: it has light of its own
constexpr size_t kRaysFirst = 4;               // of an enclosed one, one in 256 has these all open
constexpr uint32_t kTexelsOfSurfel = 16;       // that are looked at, or up to twice as many
constexpr size_t kPlacesOfTexel = 16;          // that say how much of it is open
constexpr size_t kPlacesFirst = 4; // of these: most that are not open in them are not at all
constexpr double kInsideOut = 0.5; // share of enclosed texels from which a scan is inside out

bool meetsBack(const RayScene& scene, const Ray& ray)
{
    const Hit hit = scene.intersect(ray);
    return !hit.missed() && !hit.front;
}

/// Surfels of which some ray met a surface from behind. Those of few texels are all looked at: a
/// few rays would miss one that is enclosed.
std::vector<uint8_t> suspects(const Texels& texels, const RayScene& scene)
{
    const SurfelSites sites(texels);
    std::vector<uint8_t> isSuspect(texels.surfels.count(), 0);
    forEachChunk(isSuspect.size(), 256, [&](size_t begin, size_t end) {
        for (auto s = static_cast<uint32_t>(begin); s < end; ++s) {
            if (sites.countOf(s) <= kRaysOfSurfel) isSuspect[s] = 1;
            const RaysOfSide rays(sites, Side::front(s));
            for (size_t i = 0; i < kRaysOfSurfel && isSuspect[s] == 0; ++i)
                if (meetsBack(scene, rays[i])) isSuspect[s] = 1;
        }
    });
    return isSuspect;
}

/// A place on a texel, whose rays end at backs inside a solid.
class Place
{
public:
    /// `u`: where on the texel, in its unit square.
    Place(const Footprints& prints, uint32_t texel, glm::vec2 u)
        : site_(prints.at(texel, u)),
          shift_(seededShift(prints.seed(), texel, 8), seededShift(prints.seed(), texel, 9))
    {}

    [[nodiscard]] bool isCovered(const RayScene& scene, size_t ray) const
    {
        const glm::vec2 u = evenPoint(static_cast<float>(ray), shift_);
        return meetsBack(scene, {.origin = site_.position + kOffSurface * site_.normal,
                                 .direction = cosineDirection(site_.normal, u)});
    }

private:
    TexelSite site_;
    glm::vec2 shift_;
};

bool isEnclosed(const RayScene& scene, const Footprints& prints, uint32_t texel)
{
    const Place middle(prints, texel, glm::vec2(0.5f));
    size_t open = 0;
    for (size_t i = 0; open <= kMostOpen && i - open < kRaysOfTexel - kMostOpen; ++i) {
        if (i == kRaysFirst && open == i) return false;
        open += middle.isCovered(scene, i) ? 0u : 1u;
    }
    return open <= kMostOpen;
}

/// Of a texel whose middle is covered; most of them are all over, which the first few places tell.
uint8_t openShare(const RayScene& scene, const Footprints& prints, uint32_t texel)
{
    const uint32_t seed = prints.seed();
    const glm::vec2 within(seededShift(seed, texel, 10), seededShift(seed, texel, 11));
    size_t open = 0;
    for (size_t i = 0; i < kPlacesOfTexel; ++i) {
        if (i == kPlacesFirst && open == 0) return 0;
        const Place place(prints, texel, evenPoint(static_cast<float>(i), within));
        open += place.isCovered(scene, i) ? 0u : 1u;
    }
    return static_cast<uint8_t>(255 * open / kPlacesOfTexel);
}

Rim rimOf(const Surfels& surfels, const SurfelRadiance& radiance,
          std::span<const glm::vec3> irradiance, size_t enclosed)
{
    glm::vec3 light(0.0f);
    glm::vec3 seen(0.0f);
    float count = 0.0f;
    const float reach = kRimReach * surfels.size;
    surfels.forEachInReach(surfels.position[enclosed], [&](size_t s) {
        const glm::vec3 way = surfels.position[s] - surfels.position[enclosed];
        if (surfels.isEnclosed(s) || glm::dot(way, way) > reach * reach ||
            glm::dot(surfels.normal[s], surfels.normal[enclosed]) < kRimFacing ||
            std::abs(glm::dot(way, surfels.normal[enclosed])) > kRimStep * surfels.size)
            return;
        light += irradiance[s] / kPi;
        seen += radiance.plain[s];
        count += 1.0f;
    });
    if (count == 0.0f) return {};
    return {light / count, luminance(seen) / std::max(luminance(light), kDark)};
}

/// As much of the light around as the texture tells of.
float shareByTexture(const Rim& rim, const TexelBlock& block, size_t i, const ShadingBlock& shading)
{
    const RgbBlock& direct = shading.direct;
    const RgbBlock& indirect = shading.indirect;
    const float under = luminance(glm::vec3(
        direct.r[i] + indirect.r[i], direct.g[i] + indirect.g[i], direct.b[i] + indirect.b[i]));
    return shareOfRim(luminance({block.r[i], block.g[i], block.b[i]}), under,
                      luminance(rim.shading), rim.albedo);
}

void letIn(const Rim& rim, float share, size_t i, ShadingBlock& shading)
{
    RgbBlock& direct = shading.direct;
    RgbBlock& indirect = shading.indirect;
    for (float* channel : {direct.r, direct.g, direct.b}) channel[i] *= 1.0f - share;
    indirect.r[i] += share * (rim.shading.r - indirect.r[i]);
    indirect.g[i] += share * (rim.shading.g - indirect.g[i]);
    indirect.b[i] += share * (rim.shading.b - indirect.b[i]);
}

double shareOf(const Texels& texels, const TexelMarks& enclosed)
{
    size_t count = 0;
    for (const auto& page : enclosed)
        count += static_cast<size_t>(std::count(page.begin(), page.end(), uint8_t{1}));
    return static_cast<double>(count) / static_cast<double>(texels.count());
}

/// A mark for each texel of a page: of surfels that `isAsked` is true for what `markOf` says of the
/// texel, `otherwise` of others. Of a surfel of very many texels, a few that lie beside each other
/// on the page share what it says of the middle one.
template<class IsAsked, class MarkOf>
std::vector<uint8_t> marksOf(const Texels& texels, size_t p, uint8_t otherwise,
                             const IsAsked& isAsked, const MarkOf& markOf)
{
    const PageTexels& page = texels.pages[p];
    const Footprints prints(texels, p);
    texels.willNeed(p);
    std::vector<uint8_t> marks(page.count(), otherwise);
    forEachChunk(page.runs.size() - 1, 64, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            if (!isAsked(page.runs[run].surfel)) continue;
            const uint32_t endOfRun = page.runs[run + 1].begin;
            const uint32_t together =
                std::max((endOfRun - page.runs[run].begin) / kTexelsOfSurfel, 1u);
            for (uint32_t i = page.runs[run].begin; i < endOfRun; i += together) {
                const uint32_t count = std::min(together, endOfRun - i);
                std::fill_n(&marks[i], count, markOf(prints, i + count / 2));
            }
        }
    });
    texels.letGo(p);
    return marks;
}

/// Marks the texels that something stands on or lies on; nothing where most are.
TexelMarks findEnclosed(const Texels& texels, const RayScene& scene, Progress::Stage& stage)
{
    const std::vector<uint8_t> isSuspect = suspects(texels, scene);
    stage.advance();
    TexelMarks enclosed;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        enclosed.push_back(marksOf(
            texels, p, 0, [&](uint32_t s) { return isSuspect[s] != 0; },
            [&](const Footprints& prints, uint32_t i) {
                return isEnclosed(scene, prints, i) ? uint8_t{1} : uint8_t{0};
            }));
        stage.advance();
    }
    if (shareOf(texels, enclosed) > kInsideOut) return {};
    return enclosed;
}

} // namespace

void separateEnclosed(Texels& texels, const RayScene& scene, Progress& progress)
{
    Progress::Stage stage(progress, "enclosed texels", texels.pages.size() + 2);
    const TexelMarks enclosed = findEnclosed(texels, scene, stage);
    if (!enclosed.empty()) splitSurfels(texels, enclosed, SurfelPart::enclosed);
    keepSites(texels);
    findNeighbors(texels.surfels);
    stage.advance();
}

TexelMarks openShares(const Texels& texels, const RayScene& scene)
{
    TexelMarks shares;
    for (size_t p = 0; p < texels.pages.size(); ++p)
        shares.push_back(marksOf(
            texels, p, 255, [&](uint32_t s) { return texels.surfels.isEnclosed(s); },
            [&](const Footprints& prints, uint32_t i) { return openShare(scene, prints, i); }));
    return shares;
}

std::vector<Rim> rimsOf(const Surfels& surfels, const SurfelRadiance& radiance,
                        std::span<const glm::vec3> irradiance)
{
    std::vector<Rim> rims(surfels.count());
    forEachChunk(rims.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            if (surfels.isEnclosed(s)) rims[s] = rimOf(surfels, radiance, irradiance, s);
    });
    return rims;
}

void letRimsIn(std::span<const Rim> rims, const TexelBlock& block, ShadingBlock& shading)
{
    for (size_t i = 0; i < block.count; ++i) {
        const Rim& rim = rims[block.surfel[i]];
        if (rim.albedo > 0.0f) letIn(rim, shareByTexture(rim, block, i, shading), i, shading);
    }
}

TexelShading withRims(const Texels& texels, TexelShading shade, std::vector<Rim> rims,
                      std::shared_ptr<const TexelMarks> open)
{
    return [&texels, shade = std::move(shade), open = std::move(open),
            rims = std::make_shared<const std::vector<Rim>>(std::move(rims))](
               size_t p, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        shade(p, begin, block, out);
        const PageTexels& page = texels.pages[p];
        size_t run = page.runOf(begin);
        for (size_t i = 0; i < block.count; ++i) {
            while (begin + i >= page.runs[run + 1].begin) ++run;
            const Rim& rim = (*rims)[page.runs[run].surfel];
            if (rim.albedo <= 0.0f) continue;
            letIn(rim, static_cast<float>((*open)[p][begin + i]) / 255.0f, i, out);
        }
    };
}

} // namespace relamp
