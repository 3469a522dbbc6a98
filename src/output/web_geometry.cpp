#include "output/web_geometry.h"

#include "output/web_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

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
    uint16_t normal;
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

/// Corners of triangles that are one place and one normal are one vertex.
class WebVertices
{
public:
    explicit WebVertices(const Mesh& mesh) : mesh_(mesh), box_(mesh.positions), uvBox_(mesh.uvs)
    {
        corners.reserve(3 * mesh.triangles.size());
        for (size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k)
                corners.push_back(
                    vertexOf(mesh.triangles[t][k],
                             webDirection(mesh.normals[3 * t + static_cast<size_t>(k)])));
    }

    std::vector<WebVertex> vertices;
    std::vector<uint32_t> corners;

    [[nodiscard]] const WebBox<glm::vec3>& box() const { return box_; }
    [[nodiscard]] const WebBox<glm::vec2>& uvBox() const { return uvBox_; }

private:
    uint32_t vertexOf(uint32_t position, uint16_t normal)
    {
        const auto next = static_cast<uint32_t>(vertices.size());
        const auto [known, isNew] = known_.try_emplace(uint64_t{position} << 16 | normal, next);
        if (!isNew) return known->second;
        WebVertex vertex{{}, normal, {}};
        for (int axis = 0; axis < 3; ++axis)
            vertex.position[static_cast<size_t>(axis)] =
                box_.share(mesh_.positions[position], axis);
        for (int axis = 0; axis < 2; ++axis)
            vertex.uv[static_cast<size_t>(axis)] = uvBox_.share(mesh_.uvs[position], axis);
        vertices.push_back(vertex);
        return next;
    }

    const Mesh& mesh_;
    WebBox<glm::vec3> box_;
    WebBox<glm::vec2> uvBox_;
    std::unordered_map<uint64_t, uint32_t> known_; // vertices by position and normal
};

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
    WebVertices made(mesh);
    std::vector<WebVertex>& vertices = made.vertices;
    std::vector<uint32_t>& corners = made.corners;
    putInOrder(vertices, corners);
    ordered_json item{{"page", mesh.page},
                      {"vertices", vertices.size()},
                      {"triangles", corners.size() / 3},
                      {"box", made.box().asJson()},
                      {"uvBox", made.uvBox().asJson()},
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
