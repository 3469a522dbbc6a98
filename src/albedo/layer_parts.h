#pragma once

#include "relamp/delight.h"
#include "relamp/image.h"
#include "scan/texels.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Layers of a page of this image, all 0.
PageLayers emptyLayers(const Image& image);

/// What a texel that shines looks like.
void storeEmission(glm::vec3 radiance, uint32_t pixel, std::vector<uint8_t>& emission);

/// Empties the emission where nothing shines.
void dropDarkEmission(PageLayers& layers);

/// Rates a texel again that stands for several places in different light: its albedo is right for
/// one of them at most. What has more against it keeps its doubt. Thread safe for different pixels.
void doubtShared(uint32_t pixel, PageLayers& layers);

/// Surface of a page by doubt.
class AreaOfDoubts
{
public:
    /// Adds a block's texels; it comes with areas loaded. Thread safe, and the sum does not depend
    /// on the order.
    void add(const TexelBlock& block, std::span<const uint32_t> pixels,
             std::span<const Doubt> doubtOfPixels);
    [[nodiscard]] std::array<double, kDoubts> sum() const; // m^2

private:
    std::array<std::atomic<uint64_t>, kDoubts> area_{};
};

} // namespace relamp
