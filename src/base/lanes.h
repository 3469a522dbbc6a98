#pragma once

#include <cstddef>

namespace relamp
{

/// How many texels a kernel's inner loop works on at once: the widest vector register's floats. A
/// loop of just this length, over what all lanes share, stays in registers on every machine.
inline constexpr size_t kLanes = 16;

/// Goes before a loop over arrays that do not overlap, where the compiler cannot see it.
/// And: goes before a loop as long as a register, which unrolling would take from the vectoriser.
#if defined(__clang__)
#define RELAMP_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#define RELAMP_KEEP_LOOP
#else
#define RELAMP_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#define RELAMP_KEEP_LOOP _Pragma("GCC unroll 1")
#endif

/// Arrays that kernels write are padded to whole groups of lanes.
constexpr size_t paddedToLanes(size_t count)
{
    return (count + kLanes - 1) / kLanes * kLanes;
}

} // namespace relamp
