#include "texture_pixels.h"

#include "parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace
{

constexpr size_t kSmallerLevels = 5;
constexpr int kMantissaBits = 9;
constexpr int kBias = 15;
constexpr float kLargest = 65408.0f; // 511 / 512 * 2^16

size_t bytesOf(TexelFormat format)
{
    return format == TexelFormat::grey8 ? 1 : 4;
}

/// How often a picture is halved until it is no longer than this.
uint32_t shrinkOf(const relamp::Image& image, uint32_t largest)
{
    uint32_t shrink = 1;
    while (static_cast<uint32_t>(std::max(image.width, image.height)) / shrink > largest)
        shrink *= 2;
    return shrink;
}

/// Pixels of an image and its smaller levels.
uint64_t pixelsWithLevels(const relamp::Image& image, uint32_t largest)
{
    const uint64_t shrink = shrinkOf(image, largest);
    return image.pixels() / (shrink * shrink) * 4 / 3;
}

/// sRGB bytes of linear light, by a table that is finer than a byte's steps.
class SrgbTable
{
public:
    SrgbTable()
    {
        for (size_t i = 0; i < table_.size(); ++i) {
            const float root = static_cast<float>(i) / static_cast<float>(table_.size() - 1);
            const float linear = root * root;
            const float srgb = linear <= 0.0031308f ? 12.92f * linear
                                                    : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
            table_[i] = static_cast<uint8_t>(std::lround(255.0f * srgb));
        }
    }
    [[nodiscard]] uint8_t operator()(float linear) const
    {
        const float root = std::sqrt(std::clamp(linear, 0.0f, 1.0f));
        return table_[static_cast<size_t>(root * static_cast<float>(table_.size() - 1) + 0.5f)];
    }

private:
    std::array<uint8_t, 4096> table_{};
};

/// An image, or its half, quarter …, that is not stored anywhere.
class Shrunk
{
public:
    Shrunk(const relamp::Image& image, uint32_t shrink)
        : radiance_(image), imageWidth_(static_cast<uint32_t>(image.width)),
          imageHeight_(static_cast<uint32_t>(image.height)), shrink_(shrink)
    {}

    [[nodiscard]] uint32_t width() const { return std::max(imageWidth_ / shrink_, 1u); }
    [[nodiscard]] uint32_t height() const { return std::max(imageHeight_ / shrink_, 1u); }

    /// Mean light of the pixels that a pixel of this level stands for.
    [[nodiscard]] glm::vec3 at(uint32_t x, uint32_t y) const
    {
        if (shrink_ == 1) return radiance_[size_t{y} * imageWidth_ + x];
        glm::vec3 sum(0.0f);
        for (uint32_t v = 0; v < shrink_; ++v)
            for (uint32_t u = 0; u < shrink_; ++u)
                sum += radiance_[size_t{std::min(y * shrink_ + v, imageHeight_ - 1)} * imageWidth_ +
                                 std::min(x * shrink_ + u, imageWidth_ - 1)];
        return sum / static_cast<float>(shrink_ * shrink_);
    }

private:
    relamp::Radiance radiance_;
    uint32_t imageWidth_;
    uint32_t imageHeight_;
    uint32_t shrink_;
};

void put(std::byte* at, TexelFormat format, glm::vec3 light)
{
    static const SrgbTable srgb;
    if (format == TexelFormat::rgb9e5) {
        const uint32_t packed = rgb9e5(light);
        std::memcpy(at, &packed, 4);
    } else if (format == TexelFormat::grey8) {
        *at = static_cast<std::byte>(srgb(light.r));
    } else {
        const std::array<uint8_t, 4> rgba{srgb(light.r), srgb(light.g), srgb(light.b), 255};
        std::memcpy(at, rgba.data(), 4);
    }
}

float powerOf2(int exponent)
{
    return std::bit_cast<float>(static_cast<uint32_t>(exponent + 127) << 23);
}

/// Light of one texel, as `put` stored it.
glm::vec3 lightAt(const std::byte* at, TexelFormat format)
{
    static const std::array<float, 256> linear = [] {
        std::array<float, 256> table{};
        for (size_t i = 0; i < table.size(); ++i) {
            const float s = static_cast<float>(i) / 255.0f;
            table[i] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
        }
        return table;
    }();
    if (format == TexelFormat::rgb9e5) {
        uint32_t packed = 0;
        std::memcpy(&packed, at, 4);
        return fromRgb9e5(packed);
    }
    const auto value = [&](size_t c) { return linear[static_cast<uint8_t>(at[c])]; };
    return format == TexelFormat::grey8 ? glm::vec3(value(0))
                                        : glm::vec3(value(0), value(1), value(2));
}

/// Halves the last level.
void addLevel(TexturePixels& pixels)
{
    const TexturePixels::Level above = pixels.levels.back();
    const size_t texel = bytesOf(pixels.format);
    TexturePixels::Level level{std::max(above.width / 2, 1u), std::max(above.height / 2, 1u),
                               pixels.bytes.size()};
    level.offset = (level.offset + 3) / 4 * 4; // as copies to images want it
    pixels.bytes.resize(level.offset + texel * level.width * level.height);
    const std::byte* from = pixels.bytes.data() + above.offset;
    std::byte* to = pixels.bytes.data() + level.offset;
    forEachRow(level.height, [&](size_t y) {
        for (size_t x = 0; x < level.width; ++x) {
            glm::vec3 sum(0.0f);
            for (size_t k = 0; k < 4; ++k) {
                const size_t px = std::min<size_t>(2 * x + k % 2, above.width - 1);
                const size_t py = std::min<size_t>(2 * y + k / 2, above.height - 1);
                sum += lightAt(from + texel * (py * above.width + px), pixels.format);
            }
            put(to + texel * (y * level.width + x), pixels.format, 0.25f * sum);
        }
    });
    pixels.levels.push_back(level);
}

} // namespace

uint32_t TextureLimits::lengthFor(const relamp::Scan& scan) const
{
    constexpr uint64_t kBytes =
        6 * 4 + 1; // of a pixel: six layers of four bytes, confidence of one
    constexpr uint32_t kShortest = 1024;
    const auto fits = [&](uint32_t longest) {
        uint64_t sum = 0;
        uint64_t most = 0;
        for (const relamp::Page& page : scan.pages) {
            const uint64_t pixels = pixelsWithLevels(page.image, longest);
            sum += kBytes * pixels;
            most = std::max(most, 4 * pixels);
        }
        return sum <= all && most <= image;
    };
    uint32_t longest = length;
    while (longest > kShortest && !fits(longest)) longest /= 2;
    return longest;
}

uint32_t rgb9e5(glm::vec3 rgb)
{
    glm::vec3 light(0.0f);
    for (int c = 0; c < 3; ++c) light[c] = rgb[c] > 0.0f ? std::min(rgb[c], kLargest) : 0.0f;
    const float most = std::max(light.r, std::max(light.g, light.b));
    // Of 2, so that most is in [0.5, 1) of it; by the float's own exponent, for there are millions.
    int exponent = std::max(static_cast<int>(std::bit_cast<uint32_t>(most) >> 23) - 126, -kBias);
    float perStep = powerOf2(kMantissaBits - exponent);
    const auto mantissa = [&](float v) { return static_cast<uint32_t>(v * perStep + 0.5f); };
    if (mantissa(most) == 1u << kMantissaBits) { // rounded up to the next power
        ++exponent;
        perStep *= 0.5f;
    }
    return mantissa(light.r) | mantissa(light.g) << 9 | mantissa(light.b) << 18 |
           static_cast<uint32_t>(exponent + kBias) << 27;
}

glm::vec3 fromRgb9e5(uint32_t packed)
{
    const float step = powerOf2(static_cast<int>(packed >> 27) - kBias - kMantissaBits);
    return step * glm::vec3(packed & 511u, packed >> 9 & 511u, packed >> 18 & 511u);
}

TexturePixels texturePixels(const relamp::Image& image, TexelFormat format, uint32_t largest,
                            bool hasLevels)
{
    const uint32_t shrink = hasLevels ? shrinkOf(image, largest) : 1;
    const Shrunk first(image, shrink);
    const size_t texel = bytesOf(format);
    TexturePixels pixels;
    pixels.format = format;
    pixels.levels.push_back({first.width(), first.height(), 0});
    pixels.bytes.resize(texel * first.width() * first.height());
    const bool isSame = shrink == 1 && format == TexelFormat::srgb8 &&
                        image.transfer == relamp::Transfer::srgb && image.isEncoded();
    forEachRow(first.height(), [&](size_t y) {
        for (size_t x = 0; x < first.width(); ++x) {
            std::byte* to = pixels.bytes.data() + texel * (y * first.width() + x);
            if (!isSame) {
                put(to, format, first.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)));
                continue;
            }
            std::memcpy(to, image.encoded().data() + 3 * (y * first.width() + x), 3);
            to[3] = std::byte{255};
        }
    });
    while (hasLevels && pixels.levels.size() <= kSmallerLevels && pixels.levels.back().width > 1 &&
           pixels.levels.back().height > 1)
        addLevel(pixels);
    return pixels;
}
