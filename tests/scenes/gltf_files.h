#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp::scenes
{

using Bytes = std::vector<uint8_t>;

template<class Number>
Bytes bytesOf(const std::vector<Number>& numbers)
{
    const auto bytes = std::as_bytes(std::span(numbers));
    const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
    return {first, first + bytes.size()};
}

/// What an accessor says of its numbers, with glTF's own constants.
struct Numbers
{
    int componentType = 5126; // float
    const char* type = "VEC3";
    bool normalized = false;
    size_t offset = 0; // in its buffer view
};

/// A glTF file in the making. `document` may be edited freely at any time.
struct GltfFile
{
    nlohmann::json document{{"asset", {{"version", "2.0"}}}};
    Bytes binary;

    /// Each returns the index of what it added.
    size_t addView(const Bytes& bytes, size_t stride = 0);
    size_t addAccessor(size_t view, size_t count, const Numbers& numbers);
    size_t addAccessor(const Bytes& bytes, size_t count, const Numbers& numbers);
    size_t addImage(const Bytes& file, const char* mimeType);
    /// With a texture of its own where `image` is not negative.
    size_t addMaterial(int image = -1);
    size_t addMesh(const nlohmann::json& attributes, int indices = -1, int material = -1);
    size_t addNode(const nlohmann::json& node); // of the scene

    [[nodiscard]] std::string glb() const;
    /// Only the JSON, with a buffer that is to be found at `uri`.
    [[nodiscard]] std::string gltf(const std::string& uri) const;

    nlohmann::json& primitive(size_t mesh = 0) { return document["meshes"][mesh]["primitives"][0]; }
    nlohmann::json& material(size_t i = 0) { return document["materials"][i]; }
    nlohmann::json& accessorOf(const char* attribute);
};

/// A square of one metre in the xy plane that faces z, with corners (0, 0), (1, 0), (0, 1), (1, 1)
/// and the same for texture coordinates, v downwards; two triangles; a PNG of 2 x 2 pixels: red,
/// green in the first row, blue, white in the second. One mesh "square", one node "node".
GltfFile texturedSquare();
std::vector<glm::vec3> squarePositions();
std::vector<glm::vec2> squareUvs();
std::vector<uint16_t> squareIndices();

/// The same square with COLOR_0 instead of a texture: red, green, blue, white, as linear floats.
GltfFile coloredSquare();

/// The textured square under KHR_draco_mesh_compression, and under EXT_meshopt_compression.
GltfFile dracoSquare();
GltfFile meshoptSquare();

/// What relamp reads of a file's bytes.
Scan read(const std::string& bytes, const ScanOptions& options = {},
          const std::string& name = "room.glb");

/// The sentence with which `bytes` are refused; "" where they are not.
std::string refusal(const std::string& bytes, const std::string& name = "room.glb");

std::span<const std::byte> asBytes(const std::string& text);

} // namespace relamp::scenes
