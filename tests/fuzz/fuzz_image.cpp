#include "fuzz/fuzz.h"
#include "relamp/image.h"

#include <cstring>

#include <zlib.h>

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

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned)
{
    const size_t mutated = LLVMFuzzerMutate(data, size, most);
    if (mutated > 4 && std::memcmp(data, "\x89PNG", 4) == 0) mendChecksums({data, mutated});
    return mutated;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    for (const char* name : {"fuzz", "fuzz.tga"})
        fuzz::expectResultOrSentence(name, [&] {
            const Image image = readImage(fuzz::bytesOf(data, size), name);
            if (image.encoded.size() + image.half.size() != 3 * image.pixels()) std::abort();
        });
    return 0;
}
