#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace relamp
{

// Of OpenGL, as glTF names them.
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

/// The two chunks of a GLB, or a .gltf text and no chunk.
struct GltfChunks
{
    std::string_view json;
    std::span<const std::byte> binary;
};

/// Splits a GLB, or takes `bytes` whole as JSON text. Throws Error(malformed), naming `name`.
GltfChunks splitGltf(std::span<const std::byte> bytes, const std::string& name);

/// Puts a GLB together.
std::string joinGlb(const std::string& json, std::span<const uint8_t> binary);

/// Throws Error(unsupported) on another version than glTF 2.
void checkVersion(const nlohmann::json& document, const std::string& name);

/// Throws Error(unsupported) where the file says that it cannot be understood without an extension
/// that relamp does not know. The document is one that checkShape has passed.
void checkExtensions(const nlohmann::json& document, const std::string& name);

} // namespace relamp
