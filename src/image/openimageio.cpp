// The library relamp_formats: all of relamp that names OpenImageIO. See other_formats.h.

#include "image/memory_reader.h"
#include "image/other_formats.h"

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
            .isOfFloats = spec.format.is_floating_point()};
}

template<class Sample>
bool readSamples(OIIO::ImageInput& input, Picture& picture)
{
    const PictureHeader& header = picture.header;
    const int channels = header.channelsToRead();
    std::vector<Sample> samples(static_cast<size_t>(header.width * header.height * channels));
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<Sample>::value;
    if (!input.read_image(0, 0, 0, channels, type, samples.data())) return false;
    picture.samples = std::move(samples);
    return true;
}

void read(OtherFormat& file)
{
    MemoryReader reader(file.bytes);
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    const auto input = OIIO::ImageInput::create(file.format);
    if (!input || !input->set_ioproxy(&reader) ||
        !input->open("memory." + file.format, spec, hints)) {
        file.failure = input ? input->geterror() : OIIO::geterror();
        return;
    }
    file.picture.header = headerFrom(spec);
    file.check(file.picture.header);
    const bool isRead = file.picture.header.isOfBytes ? readSamples<uint8_t>(*input, file.picture)
                                                      : readSamples<float>(*input, file.picture);
    if (!isRead) file.failure = input->geterror();
}

} // namespace
} // namespace relamp

extern "C" __attribute__((visibility("default"))) void
relampReadWithOpenImageIo(relamp::OtherFormat& file)
{
    OIIO::attribute("threads", file.threads);
    OIIO::attribute("exr_threads", file.threads);
    relamp::read(file);
}
