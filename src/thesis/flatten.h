#pragma once

#include "base/instruction_set.h"
#include "relamp/progress.h"
#include "scan/texels.h"

#include <cstdint>
#include <vector>

namespace relamp
{

struct FlattenOptions
{
    float reach = 1.5f; // of the spatial bell, in surfel sizes, 1..2
    float range = 0.2f; // of the colour bell, in square roots of radiance, > 0
};

/// A scan's colour without its fine detail: one sRGB-like byte triple a pixel, square-root encoded.
/// Pixels that no texel covers are 0.
struct Flattened
{
    std::vector<std::vector<uint8_t>> pages; // 3 * width * height each

    /// Linear RGB at a pixel of a page.
    [[nodiscard]] glm::vec3 at(size_t page, size_t pixel) const
    {
        const uint8_t* rgb = &pages[page][3 * pixel];
        const glm::vec3 root = glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0f;
        return root * root;
    }
};

/// Joint bilateral filter on the surface (Petschnigg et al. 2004, as used by Choi 2018).
///
/// Every texel becomes the mean of what lies near it in space, on the same side of the same
/// surface, and near it in colour; it looks across UV seams and never round an edge. Texels are
/// gathered by surfel and brightness first and the filter runs over these means (the bilateral grid
/// of Chen et al. 2007, with surfels for its spatial cells), so that its cost does not depend on
/// its width.
Flattened flatten(const Texels& texels, const FlattenOptions& options, Progress& progress,
                  InstructionSet set = bestInstructionSet());

} // namespace relamp
