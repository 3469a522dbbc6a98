#include "scan/gltf_json.h"

#include "base/fail.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace relamp
{
namespace
{

constexpr uint32_t kMagic = 0x46546c67; // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a;
constexpr uint32_t kBinaryChunk = 0x004e4942;
constexpr size_t kHeader = 12;
constexpr size_t kChunkHeader = 8;

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

[[noreturn]] void refuseVersion(const std::string& name, const std::string& version)
{
    fail(ErrorCode::unsupported, name,
         fmt::format(
             "is glTF version {}; relamp reads version 2. Convert it, for example with Blender",
             version));
}

/// Extensions of materials and lights never change where a surface is or which picture it shows.
bool isKnownExtension(const std::string& name)
{
    constexpr std::array kKnown{"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                "KHR_mesh_quantization",      "KHR_texture_transform",
                                "KHR_texture_basisu",         "EXT_texture_webp"};
    return name.starts_with("KHR_materials_") || name.starts_with("KHR_lights_") ||
           std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
}

} // namespace

void checkVersion(const nlohmann::json& document, const std::string& name)
{
    using nlohmann::json;
    const json asset = document.value("asset", json::object());
    const json version = asset.is_object() ? asset.value("version", json()) : json();
    if (!version.is_string())
        malformed(name, "does not say its glTF version (asset.version); is it glTF?");
    if (!version.get<std::string>().starts_with("2."))
        refuseVersion(name, version.get<std::string>());
}

void checkExtensions(const nlohmann::json& document, const std::string& name)
{
    using nlohmann::json;
    for (const json& required : document.value("extensionsRequired", json::array()))
        if (const auto extension = required.get<std::string>(); !isKnownExtension(extension))
            fail(
                ErrorCode::unsupported, name,
                fmt::format(
                    "requires the glTF extension {}, which relamp does not know; export it without",
                    extension));
}

GltfChunks splitGltf(std::span<const std::byte> bytes, const std::string& name)
{
    const auto text = [](std::span<const std::byte> part) {
        return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
    };
    if (bytes.size() < kHeader || wordAt(bytes, 0) != kMagic) return {text(bytes), {}};
    if (const uint32_t version = wordAt(bytes, 4); version != 2)
        refuseVersion(name, std::to_string(version));

    GltfChunks chunks;
    for (size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
        const size_t length = wordAt(bytes, at);
        const uint32_t type = wordAt(bytes, at + 4);
        at += kChunkHeader;
        if (length > bytes.size() - at)
            malformed(name,
                      fmt::format("is cut off: a chunk of {} bytes is announced, {} are there; "
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

} // namespace relamp
