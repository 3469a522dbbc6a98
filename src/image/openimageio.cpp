// The library relamp_formats: all of relamp that names OpenImageIO. See other_formats.h.

#include "image/memory_reader.h"
#include "image/other_formats.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace relamp
{
namespace
{

PictureHeader headerFrom(const OIIO::ImageSpec& spec)
{
    return {.width = spec.width,
            .height = spec.height,
            .depth = spec.depth,
            .tilePixels = static_cast<double>(spec.tile_width) * spec.tile_height * spec.tile_depth,
            .channels = spec.nchannels,
            .alphaChannel = spec.alpha_channel,
            .isOfBytes = spec.format.basesize() == 1,
            .isOfHalves = spec.format == OIIO::TypeHalf && spec.channelformats.empty(),
            .isOfFloats = spec.format.is_floating_point()};
}

OIIO::TypeDesc typeOf(const PictureHeader& header)
{
    if (header.isOfBytes) return OIIO::TypeUInt8;
    return header.isOfHalves ? OIIO::TypeHalf : OIIO::TypeFloat;
}

/// All rows, as many at a time as a row of tiles has, or as OpenImageIO reads at once.
bool readSamples(OIIO::ImageInput& input, const PictureHeader& header, const ByteSink& take)
{
    constexpr int kLines = 256;
    const OIIO::ImageSpec& spec = input.spec();
    const OIIO::TypeDesc type = typeOf(header);
    const int channels = header.channelsToRead();
    const bool hasTiles = spec.tile_width > 0;
    const int rows = hasTiles ? spec.tile_height : kLines;
    std::vector<std::byte> samples;
    for (int y = 0; y < spec.height; y += rows) {
        const int count = std::min(rows, spec.height - y);
        const int begin = spec.y + y;
        samples.resize(type.size() * static_cast<size_t>(header.width * count * channels));
        const bool isRead =
            hasTiles ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, begin + count,
                                        spec.z, spec.z + 1, 0, channels, type, samples.data())
                     : input.read_scanlines(0, 0, begin, begin + count, spec.z, 0, channels, type,
                                            samples.data());
        if (!isRead) return false;
        take(samples);
    }
    return true;
}

void read(OtherFormat& other)
{
    const std::string& format = other.file.format;
    MemoryReader reader(other.file.bytes);
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    const auto input = OIIO::ImageInput::create(format);
    if (!input || !input->set_ioproxy(&reader) || !input->open("memory." + format, spec, hints)) {
        other.failure = input ? input->geterror() : OIIO::geterror();
        return;
    }
    const PictureHeader header = headerFrom(spec);
    other.takeHeader(header);
    const int before = reader.shortReads(); // what is beside the picture may well be beyond the end
    if (!readSamples(*input, header, other.takeSamples))
        other.failure = input->geterror();
    else if (format == "tiff" && reader.shortReads() > before)
        other.failure = "it is cut off";
}

void write(WebpFile& file)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput writer(bytes);
    OIIO::ImageSpec spec(file.width, file.height, 3, OIIO::TypeUInt8);
    spec.attribute("compression", "webp:" + std::to_string(file.quality));
    const auto output = OIIO::ImageOutput::create("webp");
    if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&writer) ||
        !output->open("memory.webp", spec) ||
        !output->write_image(OIIO::TypeUInt8, file.rgb.data()) || !output->close()) {
        file.failure = output ? output->geterror() : OIIO::geterror();
        if (file.failure.empty()) file.failure = "it cannot be written to memory";
        return;
    }
    file.take(std::as_bytes(std::span(bytes)));
}

} // namespace
} // namespace relamp

extern "C" __attribute__((visibility("default"))) void
relampReadWithOpenImageIo(relamp::OtherFormat& other)
{
    OIIO::attribute("threads", other.threads);
    OIIO::attribute("exr_threads", other.exrThreads);
    relamp::read(other);
}

extern "C" __attribute__((visibility("default"))) void
relampWriteWithOpenImageIo(relamp::WebpFile& file)
{
    OIIO::attribute("threads", 1); // a copy of the process has no other
    relamp::write(file);
}
