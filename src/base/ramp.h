#pragma once

#include <algorithm>

namespace relamp
{

/// 0 at `from` and beyond it, 1 at `to` and beyond that, even between; `from` may be the larger.
inline float ramp(float from, float to, float value)
{
    return std::clamp((value - from) / (to - from), 0.0f, 1.0f);
}

} // namespace relamp
