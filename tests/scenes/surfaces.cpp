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
    const size_t i = block.count++;
    block.x[i] = position.x;
    block.y[i] = position.y;
    block.z[i] = position.z;
    block.nx[i] = normal.x;
    block.ny[i] = normal.y;
    block.nz[i] = normal.z;
}

} // namespace relamp::scenes
