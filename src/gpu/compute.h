// What a shader and the C++ that starts it share: arrays by address, and the structs of arguments
// made of them. The first include of every x.comp and of every x.gpu.h.
#ifndef RELAMP_GPU_COMPUTE_H
#define RELAMP_GPU_COMPUTE_H

#ifdef __cplusplus

#include "base/half.h"
#include "base/shared.h"

#include <cstdint>

namespace relamp
{
/// Four half floats, not negative, as the functions of the same names below pack and unpack them.
inline glm::uvec2 packedHalves(glm::vec4 values)
{
    const auto bits = [&](int i) { return uint32_t{halfFromFloat(values[i])}; };
    return {bits(0) | bits(1) << 16, bits(2) | bits(3) << 16};
}
inline glm::vec4 halves(glm::uvec2 packed)
{
    const auto value = [](uint32_t bits) { return floatFromHalf(static_cast<uint16_t>(bits)); };
    return {value(packed.x & 0xffffu), value(packed.x >> 16), value(packed.y & 0xffffu),
            value(packed.y >> 16)};
}

/// Address of an array on the device.
template<class T>
struct ArrayRef
{
    uint64_t address = 0;
};
} // namespace relamp

// NOLINTNEXTLINE(bugprone-macro-parentheses): a type
#define SHARED_ARRAY(Name, Element) using Name = ArrayRef<Element>;

#else

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

#include "base/shared.h"

#define SHARED_ARRAY(Name, Element)                                                                \
    layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Name                      \
    {                                                                                              \
        Element at[];                                                                              \
    };

// The struct of arguments that dispatch() is called with, as `arguments`.
#define ARGUMENTS(Type)                                                                            \
    layout(push_constant, scalar) uniform Push                                                     \
    {                                                                                              \
        Type arguments;                                                                            \
    };

layout(local_size_x = 128) in;

// Which of the threads that dispatch() asked for this is; some are one too many.
uint threadIndex()
{
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
           gl_LocalInvocationID.x;
}

// Four half floats, as base/half.h makes them.
vec4 halves(uvec2 packed)
{
    return vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
}
uvec2 packedHalves(vec4 values)
{
    const vec4 v = min(values, vec4(65504.0));
    return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw));
}

#endif

SHARED_BEGIN

SHARED_ARRAY(Uints, uint)
SHARED_ARRAY(Ints, int)
SHARED_ARRAY(Floats, float)
SHARED_ARRAY(Uvec2s, uvec2)
SHARED_ARRAY(Uvec4s, uvec4)
SHARED_ARRAY(Vec4s, vec4)

SHARED_END

#ifndef __cplusplus

// Of an array of bytes, four in a number.
uint byteAt(Uints bytes, uint i)
{
    return bytes.at[i >> 2] >> 8 * (i & 3) & 255u;
}

#endif

#endif
