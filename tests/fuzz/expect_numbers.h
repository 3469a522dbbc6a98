#pragma once

#include "relamp/image.h"
#include "relamp/lights.h"
#include "relamp/relight.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace relamp::fuzz
{

inline void expectNumber(glm::vec3 value)
{
    if (!std::isfinite(value.x + value.y + value.z)) std::abort();
}

/// Every half is finite and not negative.
inline void expectNumbers(const Image& picture)
{
    constexpr uint16_t kInfinity = 0x7c00;
    if (picture.isEncoded()) return;
    if (std::ranges::any_of(picture.half(), [](uint16_t half) { return half >= kInfinity; }))
        std::abort();
}

inline void expectNumbers(const Lights& lights)
{
    for (const Fixture& fixture : lights.fixtures) {
        expectNumber(fixture.centre);
        expectNumber(fixture.radiance);
    }
    for (const PointLight& point : lights.points) {
        expectNumber(point.position);
        expectNumber(point.intensity);
    }
    expectNumber(lights.ambient);
}

} // namespace relamp::fuzz
