#include "relamp/image.h"

#include "base/half.h"
#include "image/transfer.h"

namespace relamp
{

Radiance::Radiance(const Image& image) : image_(&image), linearOf_{}
{
    for (int i = 0; i < 256; ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        linearOf_[static_cast<size_t>(i)] =
            image.transfer == Transfer::linear ? encoded : linearFromSrgb(encoded);
    }
}

glm::vec3 Radiance::operator[](size_t pixel) const
{
    const size_t i = 3 * pixel;
    if (!image_->encoded.empty()) {
        const uint8_t* rgb = &image_->encoded[i];
        return {linearOf_[rgb[0]], linearOf_[rgb[1]], linearOf_[rgb[2]]};
    }
    const uint16_t* rgb = &image_->half[i];
    return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
}

} // namespace relamp
