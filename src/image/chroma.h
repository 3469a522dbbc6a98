#pragma once

#include <cstdint>
#include <span>

namespace relamp
{

/// Gives a picture the colour edges back that its file kept at half the resolution.
///
/// JPEG keeps brightness Y for each pixel and, mostly (4:2:0), the colour differences Cb and Cr for
/// each four; a decoder spreads those evenly, over the edges too. This spreads them along Y: joint
/// bilateral upsampling (Kopf et al. 2007) over 5 x 5 pixels of the ratios Cb / Y and Cr / Y, which
/// a shadow does not change. Y stays as it is. `rgb` is 3 * width * height sRGB bytes.
void sharpenChroma(std::span<uint8_t> rgb, int width, int height);

} // namespace relamp
