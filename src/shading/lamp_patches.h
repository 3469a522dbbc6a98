#pragma once

#include "base/instruction_set.h"
#include "scan/texels.h"
#include "shading/area_direct.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A lamp as a tree of patches: a few large ones for places far away, its own for places beside it.
/// Structure of arrays; every patch is followed by its parts.
struct LampPatches
{
    std::vector<float> x, y, z;    // m, the middle
    std::vector<float> nx, ny, nz; // mean of unit normals: shorter, the more they differ
    std::vector<float> area;       // m^2
    std::vector<float> spread;     // m^2, see wideFormFactor()
    std::vector<float> farSquared; // m^2, from where on it stands for its parts
    std::vector<float> perRamp;    // 1 / m^2, over the squares where it does so in part
    std::vector<uint32_t> after;   // the patch behind its last part
    std::vector<uint8_t> depth;    // < kMostDepth

    explicit LampPatches(const AreaLight& light);

    [[nodiscard]] size_t count() const { return x.size(); }
    [[nodiscard]] bool hasParts(size_t patch) const { return after[patch] > patch + 1; }
};

/// Irradiance of a lamp of radiance 1 that nothing stands before, at the texels of a block.
void openIrradiance(const TexelBlock& block, const LampPatches& lamp, Geometry geometry,
                    float* irradiance, InstructionSet set = bestInstructionSet());

} // namespace relamp
