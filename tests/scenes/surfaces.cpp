#include "scenes/surfaces.h"

#include <glm/geometric.hpp>

namespace relamp::scenes
{
namespace
{

Texels texelsOf(const Scan& scan)
{
    Progress progress;
    return rasterizeAtlas(scan, progress, {.texelsAcross = 2.0});
}

SurfelRadiance radianceOf(const Texels& texels)
{
    Progress progress;
    return collectRadiance(texels, progress);
}

} // namespace

Surfaces::Surfaces(Scan made)
    : scan(std::move(made)), texels(texelsOf(scan)), rays(scan), radiance(radianceOf(texels))
{}

uint32_t Surfaces::at(glm::vec3 place, glm::vec3 normal) const
{
    return texels.surfels.find(place, normal);
}

std::vector<uint32_t> Surfaces::facing(glm::vec3 normal) const
{
    std::vector<uint32_t> surfels;
    for (uint32_t s = 0; s < texels.surfels.count(); ++s)
        if (glm::dot(texels.surfels.normal[s], normal) > 0.9f) surfels.push_back(s);
    return surfels;
}

HitLists hitListsOf(const Surfaces& surfaces, size_t rays)
{
    Progress progress;
    return castHitLists(surfaces.texels, surfaces.rays, surfaces.radiance, rays, progress);
}

std::vector<InstructionSet> widerSets()
{
    std::vector<InstructionSet> sets;
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
        if (set <= bestInstructionSet()) sets.push_back(set);
    return sets;
}

void addTexel(TexelBlock& block, glm::vec3 position, glm::vec3 normal)
{
    block.add(position, normal);
}

AreaLight lightOf(const Panel& panel, int cells)
{
    std::vector<ClippedPatch> patches;
    const float area = glm::length(glm::cross(panel.alongU, panel.alongV));
    const auto across = static_cast<float>(cells);
    for (int v = 0; v < cells; ++v)
        for (int u = 0; u < cells; ++u)
            patches.push_back({panel.at((static_cast<float>(u) + 0.5f) / across,
                                        (static_cast<float>(v) + 0.5f) / across),
                               panel.normal(), area / (across * across), 0});
    return AreaLight(std::move(patches));
}

} // namespace relamp::scenes
