#pragma once

#include "relamp/picture.h"

#include <algorithm>

namespace relamp
{

/// The same picture with few rays: enough to measure its light.
inline PictureOptions smallPicture(PictureOptions options)
{
    constexpr int kLongestSide = 240;
    const int longest = std::max(options.width, options.height);
    if (longest > kLongestSide) {
        options.width = std::max(1, options.width * kLongestSide / longest);
        options.height = std::max(1, options.height * kLongestSide / longest);
    }
    options.samples = 1;
    return options;
}

} // namespace relamp
