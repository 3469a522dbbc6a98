#pragma once

#include "relamp/lights.h"
#include "thesis/emitters.h"

namespace relamp
{

/// One Fixture a connected blob of emitters; indices are those of Emitter::fixture.
std::vector<Fixture> fixturesFrom(std::span<const Emitter> emitters, int count);

/// Stands for all emitters with 2^levels point lights of equal energy, by median cut.
///
/// A patch of area A and radiance L sends the flux pi L A; the light that stands for it sends that
/// all around, I = pi L A / (4 pi). A light whose region spans several fixtures counts as of
/// the one that sends most of it.
std::vector<PointLight> pointLightsFrom(std::span<const Emitter> emitters, int levels);

/// Takes lights that are closer than `distance` metres and face the same way as one; strongest
/// first; lights that are switched off are left out.
std::vector<PointLight> mergeLights(std::span<const PointLight> lights, float distance);

} // namespace relamp
