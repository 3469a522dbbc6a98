#include "relamp/image.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/half.h"
#include "image/chroma.h"
#include "image/damage.h"
#include "image/jpeg.h"
#include "image/other_formats.h"
#include "image/png.h"
#include "image/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr int64_t kLargestSide = 65536;
constexpr int64_t kMostPixels = int64_t{1} << 29;
// A page of one colour packs into next to nothing, and one of 4096 x 4096 pixels is no burden.
// Beyond, no format that scans come in does better than deflate's 1032:1; a header that promises
// more is lying, and must not make us allocate what it promises.
constexpr int64_t kAnyFileMayUnpackTo = int64_t{1} << 26;
constexpr int64_t kMostExpansion = 1100;

int64_t mayUnpackTo(size_t bytes)
{
    return kAnyFileMayUnpackTo + kMostExpansion * static_cast<int64_t>(bytes);
}

void checkSize(const PictureHeader& header, size_t bytes, const std::string& name)
{
    const int64_t width = header.width;
    const int64_t height = header.height;
    if (width <= 0 || height <= 0 || header.channels <= 0 || header.depth > 1)
        malformed(name, "is not a flat picture");
    if (width > kLargestSide || height > kLargestSide || width * height > kMostPixels)
        malformed(name, fmt::format("its header claims {} x {} pixels, more than relamp works on; "
                                    "scale it down",
                                    width, height));
    const int64_t sampleSize = header.isOfBytes ? 1 : sizeof(float);
    if (header.tilePixels * header.channels * static_cast<double>(sampleSize) >
        static_cast<double>(mayUnpackTo(bytes)))
        malformed(name, fmt::format("its header claims tiles of {:.0f} pixels, but the file has "
                                    "only {} bytes; it is damaged",
                                    header.tilePixels, bytes));
    if (width * height * header.channelsToRead() * sampleSize > mayUnpackTo(bytes))
        malformed(name, fmt::format("its header claims {} x {} pixels, but the file has only {} "
                                    "bytes; it is damaged",
                                    width, height, bytes));
}

bool startsWith(std::span<const std::byte> bytes, std::string_view magic, size_t at = 0)
{
    return bytes.size() >= at + magic.size() &&
           std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

/// OpenImageIO's name of the format, told by content; by the file's ending where it has no mark.
std::string formatOf(std::span<const std::byte> bytes, const std::string& name)
{
    using namespace std::string_view_literals;
    if (startsWith(bytes, "\x89PNG"sv)) return "png";
    if (startsWith(bytes, "\xff\xd8\xff"sv)) return "jpeg";
    if (startsWith(bytes, "RIFF"sv) && startsWith(bytes, "WEBP"sv, 8)) return "webp";
    if (startsWith(bytes, "v/1\x01"sv)) return "openexr";
    if (startsWith(bytes, "#?"sv)) return "hdr";
    if (startsWith(bytes, "II*\0"sv) || startsWith(bytes, "MM\0*"sv)) return "tiff";
    if (startsWith(bytes, "BM"sv)) return "bmp";
    if (startsWith(bytes, "KTX 20"sv, 1))
        fail(ErrorCode::unsupported, name,
             "is in KTX2 / Basis Universal, which relamp does not read.\nExport it as JPEG or PNG, "
             "or "
             "convert it, with KTX-Software: ktx extract in.ktx2 out.png");
    if (name.ends_with(".tga") || name.ends_with(".TGA")) return "targa";
    malformed(name, "is no picture that relamp reads (JPEG, PNG, WebP, TIFF, EXR, HDR, BMP, TGA)");
}

void checkWhole(const PictureFile& file)
{
    if (file.format == "jpeg" && !isWholeJpeg(file.bytes))
        malformed(file.name, "the JPEG is cut off; copy it again");
    if (file.format == "png" && !isWholePng(file.bytes))
        malformed(file.name, "the PNG is cut off or damaged; copy it again");
}

Picture readPicture(const PictureFile& file)
{
    const size_t size = file.bytes.size();
    const auto check = [&](const PictureHeader& header) { checkSize(header, size, file.name); };
    try {
        if (file.format == "jpeg") return readJpeg(file.bytes, check);
        if (file.format == "png") return readPng(file.bytes, check);
    } catch (const UndecodablePicture& reason) {
        undecodable(file, reason.what());
    }
    constexpr int64_t kLargestPixel = 4 * sizeof(float);
    return readOtherFormat(file, std::min(mayUnpackTo(size), kMostPixels * kLargestPixel), check);
}

/// The colour of every pixel, with grey spread over the three channels.
template<class From, class To, class Convert>
void takeRgb(std::vector<From>&& from, size_t channels, std::vector<To>& rgb, Convert convert)
{
    if constexpr (std::is_same_v<From, To>)
        if (channels == 3) { // in place
            std::transform(from.begin(), from.end(), from.begin(), convert);
            rgb = std::move(from);
            return;
        }
    const size_t green = channels >= 3 ? 1 : 0;
    const size_t blue = channels >= 3 ? 2 : 0;
    const size_t pixels = from.size() / channels;
    rgb.resize(3 * pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const From* source = &from[i * channels];
        rgb[3 * i + 0] = convert(source[0]);
        rgb[3 * i + 1] = convert(source[green]);
        rgb[3 * i + 2] = convert(source[blue]);
    }
}

template<class From, class Convert>
void takeAlpha(const std::vector<From>& from, size_t channels, size_t at,
               std::vector<uint8_t>& alpha, Convert convert)
{
    const size_t pixels = from.size() / channels;
    alpha.resize(pixels);
    for (size_t i = 0; i < pixels; ++i) alpha[i] = convert(from[i * channels + at]);
    if (std::all_of(alpha.begin(), alpha.end(), [](uint8_t a) { return a == 255; })) alpha.clear();
}

float finiteOrZero(float value)
{
    return std::isfinite(value) && value > 0.0f ? value : 0.0f;
}

/// Of a half float. Behind those that are comes infinity, then NaN, then all with a sign.
float finiteOrZero(uint16_t half)
{
    constexpr uint16_t kInfinity = 0x7c00;
    return half < kInfinity ? floatFromHalf(half) : 0.0f;
}

void takeSamples(std::vector<uint8_t>&& samples, size_t channels, Transfer transfer, Image& image)
{
    image.transfer = transfer == Transfer::linear ? Transfer::linear : Transfer::srgb;
    const auto same = [](uint8_t v) { return v; };
    if (channels % 2 == 0) takeAlpha(samples, channels, channels - 1, image.alpha, same);
    takeRgb(std::move(samples), channels, image.encoded(), same);
}

template<class Finer>
void takeSamples(std::vector<Finer>&& samples, size_t channels, Transfer transfer, Image& image)
{
    image.transfer = Transfer::linear;
    const auto byte = [](Finer v) {
        return static_cast<uint8_t>(std::lround(255.0f * std::min(finiteOrZero(v), 1.0f)));
    };
    if (channels % 2 == 0) takeAlpha(samples, channels, channels - 1, image.alpha, byte);
    const bool encoded = transfer == Transfer::srgb;
    image.rgb = std::vector<uint16_t>();
    takeRgb(std::move(samples), channels, image.half(), [&](Finer value) {
        const float v = finiteOrZero(value);
        return halfFromFloat(encoded ? linearFromSrgb(v) : v);
    });
}

} // namespace

Image readImage(std::span<const std::byte> bytes, const std::string& name, Transfer transfer)
{
    const PictureFile file{bytes, name, formatOf(bytes, name)};
    checkWhole(file);
    Picture picture = readPicture(file);
    const PictureHeader& header = picture.header;

    Image image;
    image.width = static_cast<int>(header.width);
    image.height = static_cast<int>(header.height);
    image.wasJpeg = file.format == "jpeg";
    image.clipsAtWhite = !header.isOfFloats;
    if (transfer == Transfer::automatic)
        transfer = image.clipsAtWhite ? Transfer::srgb : Transfer::linear;
    const auto channels = static_cast<size_t>(header.channelsToRead());
    std::visit([&](auto& samples) { takeSamples(std::move(samples), channels, transfer, image); },
               picture.samples);
    if (header.halvesColor) sharpenChroma(image.encoded(), image.width, image.height);
    return image;
}

Image readImage(const std::filesystem::path& file, Transfer transfer)
{
    return readImage(readFile(file), file.string(), transfer);
}

} // namespace relamp
