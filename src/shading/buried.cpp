#include "shading/buried.h"

#include "base/parallel.h"
#include "scan/footprints.h"
#include "shading/hit_lists.h"
#include "shading/sampling.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfSurfel = 12; // that say whether its texels need to be looked at
constexpr size_t kRaysOfTexel = 4;
constexpr float kOffSurface = 2e-3f; // m, as hit lists start theirs
constexpr double kInsideOut = 0.5;   // share of buried texels from which a scan is inside out

bool meetsBack(const RayScene& scene, const Ray& ray)
{
    const Hit hit = scene.intersect(ray);
    return !hit.missed() && !hit.front;
}

/// Surfels of which some ray met a surface from behind. Those of few texels are all looked at,
/// which takes no more rays.
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

/// From all over a texel: where an edge of what lies on it crosses it, it is not buried, and rays
/// to lights tell how much of it is.
bool isBuried(const RayScene& scene, const Footprints& prints, uint32_t texel)
{
    const glm::vec2 shift(hashedShift(texel, 8), hashedShift(texel, 9));
    const glm::vec2 within(hashedShift(texel, 10), hashedShift(texel, 11));
    for (size_t i = 0; i < kRaysOfTexel; ++i) {
        const TexelSite site = prints.at(texel, evenPoint(static_cast<float>(i), within));
        const Ray ray{.origin = site.position + kOffSurface * site.normal,
                      .direction =
                          cosineDirection(site.normal, evenPoint(static_cast<float>(i), shift))};
        if (!meetsBack(scene, ray)) return false;
    }
    return true;
}

double shareOf(const Texels& texels, const std::vector<std::vector<uint8_t>>& buried)
{
    size_t count = 0;
    for (const auto& page : buried)
        count += static_cast<size_t>(std::count(page.begin(), page.end(), uint8_t{1}));
    return static_cast<double>(count) / static_cast<double>(texels.count());
}

} // namespace

std::vector<std::vector<uint8_t>> findBuried(const Texels& texels, const RayScene& scene,
                                             Progress& progress)
{
    Progress::Stage stage(progress, "buried", texels.pages.size() + 1);
    const std::vector<uint8_t> isSuspect = suspects(texels, scene);
    stage.advance();
    std::vector<std::vector<uint8_t>> buried;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const Footprints prints(texels, p);
        std::vector<uint8_t>& ofPage = buried.emplace_back(page.count(), uint8_t{0});
        forEachChunk(page.runs.size() - 1, 64, [&](size_t begin, size_t end) {
            for (size_t run = begin; run < end; ++run) {
                if (isSuspect[page.runs[run].surfel] == 0) continue;
                for (uint32_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                    ofPage[i] = isBuried(scene, prints, i) ? 1 : 0;
            }
        });
        stage.advance();
    }
    if (shareOf(texels, buried) > kInsideOut) return {};
    return buried;
}

std::vector<uint8_t> buriedSurfels(const Texels& texels)
{
    std::vector<uint8_t> isBuried(texels.surfels.count(), texels.buried.empty() ? 0 : 1);
    for (size_t p = 0; p < texels.buried.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            for (uint32_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                if (texels.buried[p][i] == 0) isBuried[page.runs[run].surfel] = 0;
    }
    return isBuried;
}

std::vector<glm::vec3> withoutBuried(const Surfels& surfels, std::span<const glm::vec3> irradiance,
                                     std::span<const uint8_t> isBuried)
{
    std::vector<glm::vec3> open(irradiance.begin(), irradiance.end());
    forEachChunk(open.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            if (isBuried[s] == 0) continue;
            glm::vec3 sum(0.0f);
            float count = 0.0f;
            for (const uint32_t n : surfels.neighborsOf(s)) {
                if (isBuried[n] != 0) continue;
                sum += irradiance[n];
                count += 1.0f;
            }
            if (count > 0.0f) open[s] = sum / count;
        }
    });
    return open;
}

} // namespace relamp
