#include "base/fail.h"
#include "base/file.h"
#include "image/transfer.h"
#include "image/write_image.h"
#include "output/staged_file.h"
#include "relamp/image.h"

#include "base/half.h"

#include <vector>

namespace relamp
{
namespace
{

std::vector<uint8_t> bytesOf(const Image& image)
{
    if (image.isEncoded() && image.transfer == Transfer::srgb) return image.encoded();
    const Radiance radiance(image);
    std::vector<uint8_t> bytes(3 * image.pixels());
    for (size_t i = 0; i < image.pixels(); ++i)
        for (size_t c = 0; c < 3; ++c)
            bytes[3 * i + c] = srgbByteFromLinear(radiance[i][static_cast<int>(c)]);
    return bytes;
}

std::vector<uint16_t> halvesOf(const Image& image)
{
    if (!image.isEncoded()) return image.half();
    const Radiance radiance(image);
    std::vector<uint16_t> halves(3 * image.pixels());
    for (size_t i = 0; i < image.pixels(); ++i)
        for (size_t c = 0; c < 3; ++c)
            halves[3 * i + c] = halfFromFloat(radiance[i][static_cast<int>(c)]);
    return halves;
}

} // namespace

void writeImage(const Image& image, const std::filesystem::path& file, Progress& progress)
{
    const std::string ending = file.extension().string();
    if (ending != ".png" && ending != ".exr")
        fail(ErrorCode::cannotWrite, file.string(), "must end in .png or .exr");
    const Size size{image.width, image.height};
    StagedFile staged(file, progress);
    if (ending == ".exr") {
        writeExr(staged.path(), halvesOf(image), size);
    } else {
        const std::vector<uint8_t> png = encodePng(bytesOf(image), size, 3);
        writeFile(staged.path(), std::as_bytes(std::span(png)));
    }
    progress.check();
    staged.commit();
}

} // namespace relamp
