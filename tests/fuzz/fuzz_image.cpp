#include "fuzz/targets.h"
#include "relamp/image.h"

#include <cstring>

#include <zlib.h>

namespace relamp::fuzz
{
namespace
{

/// Makes the checksums of a PNG right again; without that, no change would get further than to
/// them.
void mendChecksums(std::span<uint8_t> png)
{
    constexpr size_t kSignature = 8;
    for (size_t at = kSignature; at + 12 <= png.size();) {
        const size_t length = size_t{png[at]} << 24 | size_t{png[at + 1]} << 16 |
                              size_t{png[at + 2]} << 8 | png[at + 3];
        if (length > png.size() - at - 12) return;
        const auto crc = static_cast<uint32_t>(crc32_z(0, &png[at + 4], length + 4));
        for (size_t i = 0; i < 4; ++i)
            png[at + 8 + length + i] = static_cast<uint8_t>(crc >> (24 - 8 * i));
        at += 12 + length;
    }
}

} // namespace

size_t mutatePicture(uint8_t* data, size_t size, size_t most, unsigned /*seed*/)
{
    const size_t mutated = LLVMFuzzerMutate(data, size, most);
    if (mutated > 4 && std::memcmp(data, "\x89PNG", 4) == 0) mendChecksums({data, mutated});
    return mutated;
}

void readPicture(Input input)
{
    for (const char* name : {"fuzz", "fuzz.tga"})
        expectResultOrSentence(input, [&] {
            const Image image = readImage(bytesOf(input), name);
            if (std::visit([](const auto& rgb) { return rgb.size(); }, image.rgb) !=
                3 * image.pixels())
                std::abort();
        });
}

} // namespace relamp::fuzz
