#include "thesis/closure.h"

#include "albedo/divide.shared.h"
#include "base/parallel.h"
#include "thesis/rsm.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

/// Shading at any list of places, in blocks. `siteOf(i)` gives position and normal.
template<class SiteOf>
std::vector<glm::vec3> shadingAt(size_t count, const ThesisShading& shading, const SiteOf& siteOf)
{
    std::vector<glm::vec3> result(count);
    forEachChunk(count, TexelBlock::kCapacity, [&](size_t begin, size_t end) {
        TexelBlock block;
        ShadingBlock out;
        for (size_t i = begin; i < end; ++i) {
            const auto& [position, normal] = siteOf(i);
            block.add(position, normal);
        }
        shade(shading, block, out);
        for (size_t i = 0; i < block.count; ++i)
            result[begin + i] = {out.direct.r[i] + out.indirect.r[i],
                                 out.direct.g[i] + out.indirect.g[i],
                                 out.direct.b[i] + out.indirect.b[i]};
    });
    return result;
}

/// The shading with bounces off the albedo that it implies, instead of off the flattened texture.
ThesisShading withOwnBounces(const Texels& texels, const RayScene& scene, const Lights& lights,
                             const ThesisShading& shading, float darkest)
{
    if (!shading.bounce) return shading;
    std::vector<BounceLight> lit = reflectiveShadowMaps(
        texels, scene, lightsOfShadowMaps(lights, shading.parameters), shading.parameters.rsmSize);
    const std::vector<glm::vec3> shades = shadingAt(
        lit.size(), shading, [&](size_t i) { return std::pair(lit[i].position, lit[i].normal); });
    std::vector<Radiance> radianceOf;
    for (const Page& page : texels.scan->pages) radianceOf.emplace_back(page.image);
    for (size_t i = 0; i < lit.size(); ++i) {
        const glm::vec3 radiance = radianceOf[lit[i].page][lit[i].pixel];
        lit[i].flux *= glm::min(dividedByShading(radiance, shades[i], darkest), glm::vec3(1.0f));
    }
    ThesisShading own = shading;
    own.bounce = spread(texels, lit, shading.parameters);
    return own;
}

} // namespace

std::vector<glm::vec3> shadingOfSurfels(const Surfels& surfels, const ThesisShading& shading)
{
    return shadingAt(surfels.count(), shading,
                     [&](size_t s) { return std::pair(surfels.position[s], surfels.normal[s]); });
}

Closure closeLoop(const Texels& texels, const RayScene& scene, const SurfelLight& light,
                  const Lights& lights, const ThesisShading& shading, float darkest)
{
    const std::vector<glm::vec3> divisor = shadingOfSurfels(texels.surfels, shading);
    const ThesisShading own = withOwnBounces(texels, scene, lights, shading, darkest);
    const std::vector<glm::vec3> again = shadingOfSurfels(texels.surfels, own);
    double error = 0.0;
    double input = 0.0;
    double area = 0.0;
    for (size_t s = 0; s < divisor.size(); ++s) {
        const glm::vec3 radiance = light.radiance[s];
        const glm::vec3 albedo =
            glm::min(dividedByShading(radiance, divisor[s], darkest), glm::vec3(1.0f));
        const glm::vec3 difference = albedo * again[s] - radiance;
        error += static_cast<double>(light.area[s] * glm::dot(difference, difference) / 3.0f);
        input += static_cast<double>(light.area[s] * glm::dot(radiance, radiance) / 3.0f);
        area += static_cast<double>(light.area[s]);
    }
    if (area <= 0.0) return {};
    return {static_cast<float>(std::sqrt(error / area)),
            static_cast<float>(std::sqrt(input / area))};
}

} // namespace relamp
