#include "fuzz/gltf_target.h"
#include "scan/gltf_json.h"

#include <cstring>
#include <vector>

namespace
{

using namespace relamp;

/// Changes one chunk, so that the lengths around it stay right most of the time.
std::string mutateChunk(const GltfChunks& chunks, bool json, size_t most,
                        size_t (*mutate)(uint8_t*, size_t, size_t))
{
    const auto* begin =
        reinterpret_cast<const uint8_t*>(json ? static_cast<const void*>(chunks.json.data())
                                              : static_cast<const void*>(chunks.binary.data()));
    const size_t size = json ? chunks.json.size() : chunks.binary.size();
    std::vector<uint8_t> chunk(begin, begin + size);
    chunk.resize(std::max(most, size));
    chunk.resize(mutate(chunk.data(), size, chunk.size()));
    const auto* binary = reinterpret_cast<const uint8_t*>(chunks.binary.data());
    return json ? joinGlb({chunk.begin(), chunk.end()}, {binary, chunks.binary.size()})
                : joinGlb(std::string(chunks.json), chunk);
}

} // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    if (seed % 8 == 0) return LLVMFuzzerMutate(data, size, most);
    try {
        const GltfChunks chunks = splitGltf(fuzz::bytesOf(data, size), "");
        const std::string glb = mutateChunk(chunks, seed % 8 < 5, most, LLVMFuzzerMutate);
        if (glb.size() > most) return LLVMFuzzerMutate(data, size, most);
        std::memcpy(data, glb.data(), glb.size());
        return glb.size();
    } catch (const Error&) {
        return LLVMFuzzerMutate(data, size, most);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    fuzz::expectResultOrSentence("fuzz",
                                 [&] { fuzz::readAndWriteGltf(fuzz::bytesOf(data, size)); });
    return 0;
}
