// A GLB; or the JSON of a .gltf, and behind a NUL how it is grown.

#include "fuzz/grown.h"
#include "fuzz/targets.h"
#include "scan/gltf_json.h"
#include "scan/gltf_read.h"
#include "scan/gltf_write.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace relamp::fuzz
{
namespace
{

constexpr const char* kName = "fuzz.glb";

bool isGlb(std::string_view input)
{
    return input.starts_with("glTF");
}

/// What Mesh promises.
void expectSound(const Scan& scan)
{
    for (const Mesh& mesh : scan.meshes) {
        for (const glm::vec3& p : mesh.positions)
            if (!std::isfinite(p.x + p.y + p.z)) std::abort();
        for (const glm::uvec3& t : mesh.triangles)
            if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) std::abort();
    }
}

/// The scan as it is written back, with pages that are no pictures.
std::string written(const Scan& scan)
{
    std::vector<RelitPage> pages(scan.pages.size());
    for (size_t p = 0; p < pages.size(); ++p) {
        pages[p].vertexAlbedo.assign(
            scan.pages[p].ofVertices ? 3 * scan.pages[p].image.pixels() : 0, 0.5f);
        pages[p].albedo = {{1, 2, 3}, "image/png"};
    }
    Lights lights;
    lights.points.push_back({.intensity = glm::vec3(1.0f)});
    return writeGlb(scan, pages, lights);
}

/// Changes one chunk, so that the lengths around it stay right.
std::string withChunkMutated(const GltfChunks& chunks, bool json, size_t most)
{
    const auto* begin =
        reinterpret_cast<const uint8_t*>(json ? static_cast<const void*>(chunks.json.data())
                                              : static_cast<const void*>(chunks.binary.data()));
    const size_t size = json ? chunks.json.size() : chunks.binary.size();
    std::vector<uint8_t> chunk(begin, begin + size);
    chunk.resize(std::max(most, size));
    chunk.resize(LLVMFuzzerMutate(chunk.data(), size, chunk.size()));
    const auto* binary = reinterpret_cast<const uint8_t*>(chunks.binary.data());
    return json ? joinGlb({chunk.begin(), chunk.end()}, {binary, chunks.binary.size()})
                : joinGlb(std::string(chunks.json), chunk);
}

/// Appends a growth, or takes the place of the last.
size_t grow(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    const auto* end = data + size;
    const auto* nul = std::find(data, data + size, uint8_t{0});
    const auto growths = static_cast<size_t>(end - nul);
    if (growths > Growth::kMost * Growth::kBytes) size -= Growth::kBytes;
    if (size + 1 + Growth::kBytes > most) return LLVMFuzzerMutate(data, size, most);
    if (growths == 0) data[size++] = 0;
    for (size_t i = 0; i < Growth::kBytes; ++i) data[size++] = static_cast<uint8_t>(seed >> 8 * i);
    return size;
}

} // namespace

size_t mutateGltf(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    if (seed % 8 == 0) return LLVMFuzzerMutate(data, size, most);
    if (!isGlb(textOf({data, size})))
        return seed % 8 == 1 ? grow(data, size, most, seed * 2654435761u)
                             : LLVMFuzzerMutate(data, size, most);
    try {
        const std::string glb =
            withChunkMutated(splitGltf(bytesOf({data, size}), ""), seed % 8 < 5, most);
        if (glb.size() > most) return LLVMFuzzerMutate(data, size, most);
        std::memcpy(data, glb.data(), glb.size());
        return glb.size();
    } catch (const Error&) {
        return LLVMFuzzerMutate(data, size, most);
    }
}

/// Reads it, writes it back and reads that.
void readGltfFile(Input input)
{
    const std::string_view text = textOf(input);
    const size_t end = std::min(text.find('\0'), text.size());
    const std::string file =
        isGlb(text) ? std::string(text)
                    : grown(text.substr(0, end), input.subspan(std::min(end + 1, text.size())));
    expectResultOrSentence(input, [&] {
        Progress progress;
        const Scan scan = readGltf(std::as_bytes(std::span(file)), kName, {}, progress);
        expectSound(scan);
        const std::string again = written(scan);
        if (std::ranges::all_of(scan.pages, [](const Page& page) { return page.ofVertices; }))
            readGltf(std::as_bytes(std::span(again)), kName, {}, progress);
    });
}

} // namespace relamp::fuzz
