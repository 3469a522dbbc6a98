#include "scan/gltf_json.h"

#include "base/fail.h"

#include <cstring>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a;
constexpr uint32_t kBinaryChunk = 0x004e4942;
constexpr size_t kHeader = 12;
constexpr size_t kChunkHeader = 8;
constexpr uint64_t kLargestInteger = uint64_t{1} << 53;

uint32_t wordAt(std::span<const std::byte> bytes, size_t at)
{
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

void appendWord(std::string& bytes, size_t word)
{
    const auto value = static_cast<uint32_t>(word);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void appendChunk(std::string& glb, uint32_t type, std::string_view content, char padding)
{
    const size_t padded = (content.size() + 3) / 4 * 4;
    appendWord(glb, padded);
    appendWord(glb, type);
    glb.append(content);
    glb.append(padded - content.size(), padding);
}

} // namespace

GltfChunks splitGltf(std::span<const std::byte> bytes, const std::string& name)
{
    const auto text = [](std::span<const std::byte> part) {
        return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
    };
    if (bytes.size() < kHeader || wordAt(bytes, 0) != kMagic) return {text(bytes), {}};
    if (const uint32_t version = wordAt(bytes, 4); version != 2)
        throw Error(ErrorCode::unsupported,
                    fmt::format("{}: is glTF version {}; relamp reads version 2. Convert it, for "
                                "example with Blender",
                                name, version));

    GltfChunks chunks;
    for (size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
        const size_t length = wordAt(bytes, at);
        const uint32_t type = wordAt(bytes, at + 4);
        at += kChunkHeader;
        if (length > bytes.size() - at)
            malformed(name, fmt::format("is cut off: a chunk of {} bytes is announced, {} are there; "
                                        "copy or export it again",
                                        length, bytes.size() - at));
        const auto content = bytes.subspan(at, length);
        if (type == kJsonChunk && chunks.json.empty()) chunks.json = text(content);
        if (type == kBinaryChunk && chunks.binary.empty()) chunks.binary = content;
        at += length;
    }
    if (chunks.json.empty()) malformed(name, "is a GLB without a JSON chunk; export it again");
    return chunks;
}

std::string joinGlb(const std::string& json, std::span<const uint8_t> binary)
{
    std::string glb;
    glb.reserve(kHeader + 2 * kChunkHeader + json.size() + binary.size() + 8);
    appendWord(glb, kMagic);
    appendWord(glb, 2);
    appendWord(glb, 0);
    appendChunk(glb, kJsonChunk, json, ' ');
    if (!binary.empty())
        appendChunk(glb, kBinaryChunk,
                    {reinterpret_cast<const char*>(binary.data()), binary.size()}, '\0');
    const auto total = static_cast<uint32_t>(glb.size());
    std::memcpy(&glb[8], &total, sizeof total);
    return glb;
}

uint64_t unsignedMember(const nlohmann::json& object, const char* key, const std::string& name,
                        std::optional<uint64_t> fallback)
{
    const auto found = object.find(key);
    if (found == object.end() && fallback) return *fallback;
    if (found == object.end()) malformed(name, fmt::format("\"{}\" is missing", key));
    if (found->is_number_unsigned() && found->get<uint64_t>() <= kLargestInteger)
        return found->get<uint64_t>();
    if (found->is_number_float()) {
        const double value = found->get<double>();
        if (value >= 0 && value <= static_cast<double>(kLargestInteger))
            return static_cast<uint64_t>(value);
    }
    malformed(name, fmt::format("\"{}\" must be a non-negative integer", key));
}

} // namespace relamp
