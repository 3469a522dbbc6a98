#pragma once

#include "image/texture_noise.shared.h"
#include "relamp/image.h"
#include "relamp/response.h"

namespace relamp
{

/// That of a picture's bytes, seen through a camera with this response; none of floats.
TextureNoise textureNoiseOf(const Image& image, const Response& response);

} // namespace relamp
