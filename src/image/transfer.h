#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace relamp
{

/// IEC 61966-2-1, both ways; `encoded` and `linear` are 0..1.
inline float linearFromSrgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

inline float srgbFromLinear(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// sRGB bytes for every possible half; 64 KiB, so that a page is encoded at the speed of memory.
class SrgbFromHalf
{
public:
    SrgbFromHalf();

    /// `half` must be finite and >= 0; above 1 it is white.
    uint8_t operator()(uint16_t half) const { return byteOf_[half]; }

private:
    std::array<uint8_t, 65536> byteOf_;
};

uint8_t srgbByteFromLinear(float linear);

} // namespace relamp
