#pragma once

#include <bit>
#include <cstdint>

namespace relamp
{

inline constexpr float kLargestHalf = 65504.0f;
inline constexpr float kSmallestHalf = 6.103515625e-05f; // normal; what is smaller becomes 0

/// IEEE half bits of a non-negative float: rounded to nearest even, larger than the largest half
/// (and NaN) becomes the largest, smaller than the smallest normal becomes 0. No branches, so that
/// loops over it vectorise.
inline uint16_t halfFromFloat(float value)
{
    const float clamped = value < kLargestHalf ? value : kLargestHalf;
    const uint32_t bits = std::bit_cast<uint32_t>(clamped);
    const uint32_t rounded = bits + 0xfffu + ((bits >> 13) & 1u);
    const uint32_t half = (rounded - (112u << 23)) >> 13;
    return static_cast<uint16_t>(clamped < kSmallestHalf ? 0u : half);
}

/// The float that halfFromFloat's result stands for. Subnormal halves, which it never makes, read
/// as 0.
inline float floatFromHalf(uint16_t half)
{
    const uint32_t bits = (static_cast<uint32_t>(half) << 13) + (112u << 23);
    return half < 0x400u ? 0.0f : std::bit_cast<float>(bits);
}

} // namespace relamp
