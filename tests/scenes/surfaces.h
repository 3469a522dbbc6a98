#pragma once

#include "base/instruction_set.h"
#include "lights/area_light.h"
#include "lights/surfel_radiance.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "scenes/scenes.h"
#include "shading/hit_lists.h"

#include <vector>

namespace relamp::scenes
{

/// A scan as the stages of the gather solver get it.
struct Surfaces
{
    Scan scan;
    Texels texels; // of `scan`, so this stays where it is
    RayScene rays;
    SurfelRadiance radiance;

    explicit Surfaces(Scan made);
    Surfaces(const Surfaces&) = delete;
    Surfaces& operator=(const Surfaces&) = delete;

    /// The surfel of a place of the surface, facing `normal`.
    [[nodiscard]] uint32_t at(glm::vec3 place, glm::vec3 normal) const;
    /// Surfels that face `normal`.
    [[nodiscard]] std::vector<uint32_t> facing(glm::vec3 normal) const;
};

HitLists hitListsOf(const Surfaces& surfaces, size_t rays);

/// Instruction sets of this machine beyond the baseline.
std::vector<InstructionSet> widerSets();

/// A texel of a block.
void addTexel(TexelBlock& block, glm::vec3 position, glm::vec3 normal);

/// A panel cut into cells x cells patches.
AreaLight lightOf(const Panel& panel, int cells);

} // namespace relamp::scenes
