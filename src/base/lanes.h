#pragma once

#include <cstddef>

namespace relamp
{

/// How many texels a kernel's inner loop works on at once: the widest vector register's floats. A
/// loop of just this length, over what all lanes share, stays in registers on every machine.
inline constexpr size_t kLanes = 16;

/// Arrays that kernels write are padded to whole groups of lanes.
constexpr size_t paddedToLanes(size_t count)
{
    return (count + kLanes - 1) / kLanes * kLanes;
}

} // namespace relamp
