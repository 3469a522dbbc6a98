#pragma once

#include "relight/relighter_state.h"

#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Albedo of surfels, without what of them is a lamp that is on: what that would reflect is in its
/// radiance.
std::vector<glm::vec3> reflecting(const Relighter::State& state);

/// Radiance of a page's texels: albedo * shading, and what lamps that are on send.
Image relitPage(const Relighter::State& state, size_t page, Progress& progress);

/// Their albedo as light meets it (RoomAlbedo), linear.
Image albedoPage(const Relighter::State& state, size_t page);

/// Their shading, irradiance / pi, in a picture whose sides are halved until none is longer than
/// `longestSide`; 0: as large as the page.
Image shadingPage(const Relighter::State& state, size_t page, int longestSide, Progress& progress);

} // namespace relamp
