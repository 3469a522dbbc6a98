#pragma once

#include "relamp/image.h"
#include "relamp/scan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

enum class TexelFormat {
    srgb8,  // RGBA, 8 bits each
    rgb9e5, // three mantissas and their exponent in 32 bits: light that may be brighter than 1
    grey8
};

/// A picture with its smaller levels, as a graphics device samples it.
struct TexturePixels
{
    struct Level
    {
        uint32_t width = 0;
        uint32_t height = 0;
        size_t offset = 0; // bytes
    };
    TexelFormat format = TexelFormat::srgb8;
    std::vector<Level> levels;
    std::vector<std::byte> bytes;
};

/// What a graphics device takes.
struct TextureLimits
{
    uint32_t length = 4096;             // of an image, pixels along its longer side
    uint64_t image = uint64_t{1} << 30; // of an image, bytes
    uint64_t all = uint64_t{1} << 32;   // of all images of a room, bytes

    /// Pixels along the longer side of a page at which all layers of all of them fit: `length`, or
    /// halved until they do, to 1024.
    [[nodiscard]] uint32_t lengthFor(const relamp::Scan& scan) const;
};

/// `rgb` in 9 bits of mantissa each and a common exponent of 5 bits; negative and NaN become 0,
/// what is above 65408 becomes that.
uint32_t rgb9e5(glm::vec3 rgb);
glm::vec3 fromRgb9e5(uint32_t packed);

/// The picture and, where it is not a list of vertices, its half, quarter … as means of light.
///
/// What is wider or higher than `largest` is halved before. There are at most five smaller levels:
/// in still smaller ones the charts of an atlas run into each other.
TexturePixels texturePixels(const relamp::Image& image, TexelFormat format, uint32_t largest,
                            bool hasLevels);
