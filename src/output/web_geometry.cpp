#include "output/web_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <meshoptimizer.h>

namespace relamp
{
namespace
{

using nlohmann::ordered_json;

/// As the browser reads it: a multiple of 4 bytes, which meshoptimizer wants.
struct WebVertex
{
    std::array<uint16_t, 3> position;
    uint16_t nothing;
    std::array<uint16_t, 2> uv;
};
static_assert(sizeof(WebVertex) == 12);

constexpr float kSteps = 65535.0f;

/// A box around points, of which each is a share of its extent.
template<class Vector>
struct WebBox
{
    explicit WebBox(const std::vector<Vector>& points)
        : low(std::numeric_limits<float>::max()), extent(std::numeric_limits<float>::lowest())
    {
        for (const Vector& p : points) {
            low = glm::min(low, p);
            extent = glm::max(extent, p);
        }
        extent = glm::max(extent - low, Vector(1e-6f));
    }

    [[nodiscard]] uint16_t share(const Vector& p, int axis) const
    {
        return static_cast<uint16_t>(
            std::lround(kSteps * std::clamp((p[axis] - low[axis]) / extent[axis], 0.0f, 1.0f)));
    }
    [[nodiscard]] ordered_json asJson() const
    {
        ordered_json lows = ordered_json::array();
        ordered_json extents = ordered_json::array();
        for (int axis = 0; axis < Vector::length(); ++axis) {
            lows.push_back(low[axis]);
            extents.push_back(extent[axis]);
        }
        return {{"low", std::move(lows)}, {"extent", std::move(extents)}};
    }

    Vector low;
    Vector extent;
};

std::vector<WebVertex> verticesOf(const Mesh& mesh, const WebBox<glm::vec3>& box,
                                  const WebBox<glm::vec2>& uvBox)
{
    std::vector<WebVertex> vertices(mesh.positions.size());
    for (size_t i = 0; i < vertices.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis)
            vertices[i].position[static_cast<size_t>(axis)] = box.share(mesh.positions[i], axis);
        for (int axis = 0; axis < 2; ++axis)
            vertices[i].uv[static_cast<size_t>(axis)] = uvBox.share(mesh.uvs[i], axis);
    }
    return vertices;
}

/// In an order that a GPU, and meshoptimizer's encoders, like best.
void putInOrder(std::vector<WebVertex>& vertices, std::vector<uint32_t>& corners)
{
    meshopt_optimizeVertexCache(corners.data(), corners.data(), corners.size(), vertices.size());
    const size_t used =
        meshopt_optimizeVertexFetch(vertices.data(), corners.data(), corners.size(),
                                    vertices.data(), vertices.size(), sizeof(WebVertex));
    vertices.resize(used);
}

/// Appends what an encoder of meshoptimizer makes; where it lies.
template<class Encode>
ordered_json append(std::vector<uint8_t>& bytes, size_t most, const Encode& encode)
{
    const size_t offset = bytes.size();
    bytes.resize(offset + most);
    const size_t size = encode(bytes.data() + offset, most);
    bytes.resize(offset + size);
    return {{"offset", offset}, {"bytes", size}};
}

const char* wordOf(Wrap wrap)
{
    if (wrap == Wrap::repeat) return "repeat";
    return wrap == Wrap::mirror ? "mirror" : "clamp";
}

ordered_json addMesh(const Mesh& mesh, std::vector<uint8_t>& bytes)
{
    const WebBox<glm::vec3> box(mesh.positions);
    const WebBox<glm::vec2> uvBox(mesh.uvs);
    std::vector<WebVertex> vertices = verticesOf(mesh, box, uvBox);
    std::vector<uint32_t> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3 t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    putInOrder(vertices, corners);
    ordered_json item{{"page", mesh.page},
                      {"vertices", vertices.size()},
                      {"triangles", corners.size() / 3},
                      {"box", box.asJson()},
                      {"uvBox", uvBox.asJson()},
                      {"wrap", {wordOf(mesh.wrapU), wordOf(mesh.wrapV)}}};
    item["vertexData"] =
        append(bytes, meshopt_encodeVertexBufferBound(vertices.size(), sizeof(WebVertex)),
               [&](uint8_t* to, size_t most) {
                   return meshopt_encodeVertexBuffer(to, most, vertices.data(), vertices.size(),
                                                     sizeof(WebVertex));
               });
    item["indexData"] =
        append(bytes, meshopt_encodeIndexBufferBound(corners.size(), vertices.size()),
               [&](uint8_t* to, size_t most) {
                   return meshopt_encodeIndexBuffer(to, most, corners.data(), corners.size());
               });
    return item;
}

} // namespace

WebGeometry webGeometry(const Scan& scan)
{
    // What every browser's decoder knows.
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    WebGeometry geometry{{}, ordered_json::array()};
    for (const Mesh& mesh : scan.meshes)
        if (!mesh.triangles.empty()) geometry.meshes.push_back(addMesh(mesh, geometry.bytes));
    return geometry;
}

} // namespace relamp
