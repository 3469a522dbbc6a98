#include "image/transfer.h"

#include "base/half.h"

#include <algorithm>

namespace relamp
{

uint8_t srgbByteFromLinear(float linear)
{
    return static_cast<uint8_t>(
        std::lround(255.0f * srgbFromLinear(std::clamp(linear, 0.0f, 1.0f))));
}

SrgbFromHalf::SrgbFromHalf() : byteOf_{}
{
    constexpr uint16_t kOne = 0x3c00;
    for (uint32_t half = 0; half < byteOf_.size(); ++half)
        byteOf_[half] =
            half >= kOne ? 255 : srgbByteFromLinear(floatFromHalf(static_cast<uint16_t>(half)));
}

} // namespace relamp
