#include "image/write_image.h"

#include "base/child_process.h"
#include "base/fail.h"
#include "base/file.h"

#include <algorithm>
#include <cassert>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

namespace relamp
{
namespace
{

/// A file in memory, for OpenEXR to write.
class MemoryWriter : public Imf::OStream
{
public:
    MemoryWriter() : OStream("memory") {}

    void write(const char* from, int count) override
    {
        const auto end = at_ + static_cast<size_t>(count);
        bytes_.resize(std::max(bytes_.size(), end));
        std::copy_n(reinterpret_cast<const std::byte*>(from), count, &bytes_[at_]);
        at_ = end;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t to) override { at_ = to; }

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
    size_t at_ = 0;
};

void encodeExr(std::span<const uint16_t> rgb, Size size, MemoryWriter& writer)
{
    // Lossless; the fastest and the smallest of OpenEXR's for such pictures.
    Imf::Header header(size.width, size.height);
    header.compression() = Imf::PIZ_COMPRESSION;
    Imf::FrameBuffer frame;
    // OpenEXR only reads what it calls not const.
    auto* samples = const_cast<char*>(reinterpret_cast<const char*>(rgb.data()));
    constexpr size_t kPixel = 3 * sizeof(uint16_t);
    for (const char* channel : {"R", "G", "B"}) {
        header.channels().insert(channel, Imf::Channel(Imf::HALF));
        frame.insert(channel, Imf::Slice(Imf::HALF, samples, kPixel,
                                         kPixel * static_cast<size_t>(size.width)));
        samples += sizeof(uint16_t);
    }
    const auto delay = delayCopies(); // which would find OpenEXR's threads gone, with their work
    Imf::OutputFile file(writer, header);
    file.setFrameBuffer(frame);
    file.writePixels(size.height);
}

} // namespace

std::vector<uint8_t> withAlpha(std::span<const uint8_t> rgb, std::span<const uint8_t> alpha)
{
    std::vector<uint8_t> rgba(4 * alpha.size());
    for (size_t i = 0; i < alpha.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) rgba[4 * i + c] = rgb[3 * i + c];
        rgba[4 * i + 3] = alpha[i];
    }
    return rgba;
}

void writeExr(const std::filesystem::path& file, std::span<const uint16_t> rgb, Size size)
{
    assert(rgb.size() == 3 * static_cast<size_t>(size.width) * static_cast<size_t>(size.height));
    MemoryWriter writer;
    encodeExr(rgb, size, writer); // to memory: OpenEXR does not tell when a file cannot be closed
    writeFile(file, writer.bytes());
}

} // namespace relamp
