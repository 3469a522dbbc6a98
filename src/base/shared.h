#ifndef RELAMP_SHARED_H
#define RELAMP_SHARED_H

// The first include of every x.shared.h: what lets one formula be C++ and GLSL. (glslang knows no
// #pragma once.)
//
// Such a file uses GLSL's own words (vec3, dot, max …) and nothing else; in C++ these are GLM's.
#ifdef __cplusplus

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace relamp
{
using namespace glm; // NOLINT: the point of this header
}

#define SHARED_BEGIN                                                                               \
    namespace relamp                                                                               \
    {
#define SHARED_END }
#define SHARED_FN [[gnu::always_inline]] inline
#define SHARED_CONST inline constexpr float
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_CONST const float
#endif

#endif
