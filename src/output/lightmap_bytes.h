#pragma once

#include "base/half.h"
#include "base/parallel.h"
#include "image/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace relamp
{

inline constexpr float kLightmapRoot = 4.0f; // an eye sees steps of dark and bright alike

/// The brightest of linear half floats; 1 where all are 0.
inline float scaleOfLightmap(const std::vector<uint16_t>& half)
{
    float most = 0.0f;
    for (const uint16_t value : half) most = std::max(most, floatFromHalf(value));
    return most > 0.0f ? most : 1.0f;
}

/// 255 (value / scale)^(1/4).
inline std::vector<uint8_t> lightmapBytes(const std::vector<uint16_t>& half, float scale)
{
    std::vector<uint8_t> bytes(half.size());
    forEachChunk(half.size(), size_t{1} << 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            bytes[i] = static_cast<uint8_t>(
                std::lround(255.0f * std::pow(std::min(floatFromHalf(half[i]) / scale, 1.0f),
                                              1.0f / kLightmapRoot)));
    });
    return bytes;
}

/// sRGB of linear half floats.
inline std::vector<uint8_t> srgbBytes(const std::vector<uint16_t>& half)
{
    std::vector<uint8_t> bytes(half.size());
    forEachChunk(half.size(), size_t{1} << 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) bytes[i] = srgbByteFromLinear(floatFromHalf(half[i]));
    });
    return bytes;
}

} // namespace relamp
