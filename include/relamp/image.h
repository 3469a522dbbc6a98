#pragma once

#include "relamp/api.h"
#include "relamp/progress.h"
#include "relamp/response.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How the numbers in a file relate to light.
enum class Transfer {
    automatic, // by type: 8 and 16 bit integers are sRGB, floats are linear
    srgb,
    linear,
};

/// A picture of light: RGB, row 0 on top, plus opacity where the file had any.
///
/// The pixels of 8-bit files stay as they are; everything finer is kept as linear IEEE half floats,
/// finite, >= 0. It is one of the two, 3 * width * height.
struct Image
{
    int width = 0;
    int height = 0;
    Transfer transfer = Transfer::srgb; // of bytes; never `automatic`
    bool clipsAtWhite = true; // false where the file can hold more than white (float formats)
    bool wasJpeg = false;     // came as a JPEG file
    std::variant<std::vector<uint8_t>, std::vector<uint16_t>> rgb; // bytes, or half floats
    std::vector<uint8_t> alpha; // width * height, or empty where all is opaque

    [[nodiscard]] bool isEncoded() const
    {
        return std::holds_alternative<std::vector<uint8_t>>(rgb);
    }
    /// The bytes, where it isEncoded(), and the half floats, where it is not; else both throw
    /// std::bad_variant_access.
    [[nodiscard]] std::vector<uint8_t>& encoded() { return std::get<std::vector<uint8_t>>(rgb); }
    [[nodiscard]] const std::vector<uint8_t>& encoded() const
    {
        return std::get<std::vector<uint8_t>>(rgb);
    }
    [[nodiscard]] std::vector<uint16_t>& half() { return std::get<std::vector<uint16_t>>(rgb); }
    [[nodiscard]] const std::vector<uint16_t>& half() const
    {
        return std::get<std::vector<uint16_t>>(rgb);
    }

    [[nodiscard]] size_t pixels() const
    {
        return static_cast<size_t>(width) * static_cast<size_t>(height);
    }
};

/// Linear values of an Image's pixels; a small table that is worth keeping over many look-ups.
class RELAMP_API Radiance
{
public:
    /// `response` undoes what the camera made of light; of textures that can hold more than white
    /// nothing is undone.
    explicit Radiance(const Image& image, const Response& response = {});

    /// Linear RGB at `pixel` = row * width + column; >= 0, finite, 1 = the file's white.
    [[nodiscard]] glm::vec3 operator[](size_t pixel) const
    {
        if (bytes_ == nullptr) return fromHalf(3 * pixel);
        const uint8_t* rgb = bytes_ + 3 * pixel;
        return {linearOf_[rgb[0]], linearOf_[rgb[1]], linearOf_[rgb[2]]};
    }

    /// Brings a pixel near that will be asked for soon.
    void prefetch(size_t pixel) const
    {
        bytes_ != nullptr ? __builtin_prefetch(bytes_ + 3 * pixel)
                          : __builtin_prefetch(half_ + 3 * pixel);
    }

private:
    [[nodiscard]] glm::vec3 fromHalf(size_t at) const;

    const uint8_t* bytes_; // null where the image is in half floats
    const uint16_t* half_;
    std::array<float, 256> linearOf_;
    Response response_; // of half floats
};

/// Reads JPEG, PNG, WebP, TIFF, EXR, HDR and whatever else OpenImageIO knows.
///
/// `bytes` is the file's content, `name` what to call it in an error. NaN, infinite and negative
/// values of float files become 0. Throws Error(malformed) on damaged or absurdly large pictures.
RELAMP_API Image readImage(std::span<const std::byte> bytes, const std::string& name,
                           Transfer transfer = Transfer::automatic);
RELAMP_API Image readImage(const std::filesystem::path& file,
                           Transfer transfer = Transfer::automatic);

/// Writes `image` without its opacity as .png, 8 bits of sRGB, or as .exr, linear half floats,
/// whole or not at all. Throws Error(cannotWrite | cancelled), the former of any other ending, too.
RELAMP_API void writeImage(const Image& image, const std::filesystem::path& file,
                           Progress& progress = unwatched());

} // namespace relamp
