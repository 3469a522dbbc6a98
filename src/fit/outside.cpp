#include "fit/outside.h"

#include "lights/candidates.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kUpright = 0.7f; // upward part of a pane's normal, less

bool isPane(const FoundLamp& lamp)
{
    const Candidate surface = candidateOf(lamp.patches);
    return surface.area > kPaneArea && isFlat(surface) && std::abs(surface.normal.y) < kUpright;
}

/// Which triangles mostly show a pane.
std::vector<uint8_t> trianglesOfPanes(const Texels& texels, const SurfelRadiance& radiance,
                                      const FoundLamps& found)
{
    std::vector<uint8_t> isPaneSurfel(texels.surfels.count(), 0);
    for (const FoundLamp& lamp : found.lamps)
        if (isPane(lamp))
            for (const ClippedPatch& patch : lamp.patches)
                if (patch.surfel != Surfels::kNone) isPaneSurfel[patch.surfel] = 1;
    std::vector<int32_t> excess(texels.facets.facets.size(), 0); // texels that do, less the others
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i) {
                const bool isOfPane = isPaneSurfel[page.runs[run].surfel] != 0 &&
                                      radiance.isClipped[p][page.pixel[i]];
                excess[page.facet[i]] += isOfPane ? 1 : -1;
            }
        texels.letGo(p);
    }
    std::vector<uint8_t> isOfPane(texels.facets.triangles, 0);
    for (size_t t = 0; t < isOfPane.size(); ++t) isOfPane[t] = excess[t] > 0 ? 1 : 0;
    return isOfPane;
}

} // namespace

RayScene sceneWithoutPanes(const RayScene& scene, const Texels& texels,
                           const SurfelRadiance& radiance, const FoundLamps& found)
{
    return scene.without(trianglesOfPanes(texels, radiance, found));
}

} // namespace relamp
