#pragma once

#include "scan/texels.h"

#include <array>

#include <glm/vec3.hpp>

namespace relamp
{

/// A flat rectangle that shines to the side that `facing` points to.
struct ShiningRectangle
{
    std::array<glm::vec3, 4> corners; // m; anticlockwise for whom it shines on
    glm::vec3 facing;                 // unit
};

/// Irradiance of a rectangle of radiance 1 on a surface at `place` that faces `normal` (unit),
/// nothing in the way: exact at any distance. Zero from behind, in its plane, and for the part of
/// it that lies below the surface's horizon. Lambert, Photometria (1760): the sum over the edges of
/// what is seen, half the angle that each is seen under times the cosine between `normal` and the
/// normal of the plane through edge and place; as in Baum, Rushmeier, Winget 1989.
float irradianceOf(const ShiningRectangle& rectangle, glm::vec3 place, glm::vec3 normal);

/// The same at the texels of a block.
void irradianceOf(const ShiningRectangle& rectangle, const TexelBlock& block, float* irradiance);

} // namespace relamp
