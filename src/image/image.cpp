#include "relamp/image.h"

#include "base/half.h"
#include "image/transfer.h"

namespace relamp
{

Radiance::Radiance(const Image& image, const Response& response)
    : bytes_(image.isEncoded() ? image.encoded().data() : nullptr),
      half_(image.isEncoded() ? nullptr : image.half().data()), linearOf_{},
      response_(image.clipsAtWhite ? response : Response{})
{
    for (int i = 0; i < 256; ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        linearOf_[static_cast<size_t>(i)] =
            response_(image.transfer == Transfer::linear ? encoded : linearFromSrgb(encoded));
    }
}

glm::vec3 Radiance::fromHalf(size_t at) const
{
    const uint16_t* rgb = half_ + at;
    return {response_(floatFromHalf(rgb[0])), response_(floatFromHalf(rgb[1])),
            response_(floatFromHalf(rgb[2]))};
}

} // namespace relamp
