#include "scan/footprints.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace relamp
{

Footprints::Footprints(const Texels& texels, size_t page)
    : texels_(texels), page_(texels.pages[page]),
      width_(static_cast<uint32_t>(texels.scan->pages[page].image.width)),
      isSpread_(!texels.scan->pages[page].ofVertices)
{}

TexelSite Footprints::at(size_t texel, glm::vec2 u) const
{
    const Facet& facet = texels_.facets.facets[page_.facet[texel]];
    const uint32_t pixel = page_.pixel[texel];
    const glm::vec2 off = isSpread_ ? u - 0.5f : glm::vec2(0.0f);
    const float x = static_cast<float>(pixel % width_) + off.x - facet.pixel.x;
    const float y = static_cast<float>(pixel / width_) + off.y - facet.pixel.y;
    return {facet.position + x * facet.positionX + y * facet.positionY,
            glm::normalize(facet.normal + x * facet.normalX + y * facet.normalY)};
}

} // namespace relamp
