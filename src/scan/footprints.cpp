#include "scan/footprints.h"

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
    const glm::vec2 centre(pixel % width_, pixel / width_);
    return siteOn(facet, isSpread_ ? centre + u - 0.5f : centre);
}

} // namespace relamp
