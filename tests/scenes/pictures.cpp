#include "scenes/pictures.h"

#include "base/child_process.h"

#include <span>
#include <stdexcept>

#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace relamp::scenes
{
namespace
{

using Bytes = std::vector<uint8_t>;

void appendWord(Bytes& bytes, uint32_t word)
{
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<uint8_t>(word >> shift));
}

uint32_t crcOf(std::span<const uint8_t> bytes)
{
    uint32_t crc = ~0u;
    for (const uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    return ~crc;
}

/// A chunk of a PNG.
void appendChunk(Bytes& png, const std::string& type, const Bytes& content)
{
    appendWord(png, static_cast<uint32_t>(content.size()));
    const size_t begin = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), content.begin(), content.end());
    appendWord(png, crcOf(std::span(png).subspan(begin)));
}

/// A zlib stream that holds `bytes` as they are.
Bytes stored(const Bytes& bytes)
{
    const auto size = static_cast<uint8_t>(bytes.size());
    Bytes stream{0x78, 0x01, 1, size, 0, static_cast<uint8_t>(~size), 0xff};
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    uint32_t a = 1;
    uint32_t b = 0;
    for (const uint8_t byte : bytes) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    appendWord(stream, b << 16 | a);
    return stream;
}

Bytes pngWithPalette(uint32_t width, uint32_t height)
{
    Bytes header;
    appendWord(header, width);
    appendWord(header, height);
    header.insert(header.end(), {8, 3, 0, 0, 0}); // eight bits, palette
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    appendChunk(png, "IHDR", header);
    appendChunk(png, "PLTE", fourColors().samples);
    appendChunk(png, "IDAT", stored({0, 0, 1, 0, 2, 3})); // each row begins with its filter
    appendChunk(png, "IEND", {});
    return png;
}

template<class Sample>
std::vector<uint8_t> written(const std::string& format, const Pixels<Sample>& pixels,
                             const std::string& subsampling, const std::string& fileType)
{
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<Sample>::value;
    OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels,
                         fileType.empty() ? type : OIIO::TypeDesc(fileType));
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["compression"] = format == "jpeg" ? "jpeg:100" : "zip";
    spec["jpeg:subsampling"] = subsampling;
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput target(file);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&target) || !output->open("memory." + format, spec) ||
        !output->write_image(type, pixels.samples.data()) || !output->close())
        throw std::runtime_error(output ? output->geterror() : OIIO::geterror());
    return file;
}

} // namespace

/// OpenImageIO's threads begin here as well as in the copies that read, and a copy of this process
/// may find what they lock locked for ever: so they begin in a copy of their own.
template<class Sample>
std::vector<uint8_t> pictureFile(const std::string& format, const Pixels<Sample>& pixels,
                                 const std::string& subsampling, const std::string& fileType)
{
    std::vector<uint8_t> file;
    runInChild(
        [&](const ByteSink& send) {
            const int threads = Imf::globalThreadCount() + 1; // the others are not in the copy
            Imf::setGlobalThreadCount(threads);
            OIIO::attribute("exr_threads", threads);
            const std::vector<uint8_t> bytes = written(format, pixels, subsampling, fileType);
            send(std::as_bytes(std::span(bytes)));
        },
        [&](std::span<const std::byte> piece) {
            const auto* begin = reinterpret_cast<const uint8_t*>(piece.data());
            file.insert(file.end(), begin, begin + piece.size());
        },
        {}, {format, "The test's picture was not written"}, unwatched());
    return file;
}

template std::vector<uint8_t> pictureFile(const std::string&, const Pixels<uint8_t>&,
                                          const std::string&, const std::string&);
template std::vector<uint8_t> pictureFile(const std::string&, const Pixels<uint16_t>&,
                                          const std::string&, const std::string&);
template std::vector<uint8_t> pictureFile(const std::string&, const Pixels<float>&,
                                          const std::string&, const std::string&);

Pixels<uint8_t> fourColors()
{
    return {2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
}

Bytes palettePng()
{
    return pngWithPalette(2, 2);
}

Bytes pngClaiming(uint32_t width, uint32_t height)
{
    return pngWithPalette(width, height);
}

} // namespace relamp::scenes
