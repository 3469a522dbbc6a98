#include "room_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace
{

constexpr float kFinest = 0.03f;          // m
constexpr double kTriangles = 150000.0;   // to aim at
constexpr float kSameSide = 0.8f;         // cosine between normals of one side of a crease
constexpr int kMostRounds = 12;           // an edge becomes 4096 times shorter
constexpr size_t kMostVertices = 4000000; // even of a scan of a whole house

/// One mesh on its way into the room's.
struct Piece
{
    std::vector<RoomVertex> vertices;
    std::vector<glm::vec3> normals; // sums
    std::vector<glm::uvec3> triangles;
    std::vector<uint32_t> edges; // of the triangles before they were cut
};

double areaOf(const relamp::Scan& scan)
{
    double area = 0.0;
    for (const relamp::Mesh& mesh : scan.meshes)
        for (const glm::uvec3& t : mesh.triangles)
            area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                 mesh.positions[t.z] - mesh.positions[t.x]));
    return area;
}

/// Gives every vertex of a mesh its copies, one a side of a crease.
class Sides
{
public:
    Sides(const relamp::Mesh& mesh, const relamp::Image& page, Piece& piece)
        : mesh_(mesh), page_(page), piece_(piece), firstCopy_(mesh.positions.size(), kNone)
    {}

    uint32_t copyOf(uint32_t vertex, glm::vec3 normal)
    {
        uint32_t* at = &firstCopy_[vertex];
        while (*at != kNone) {
            const glm::vec3 known = glm::normalize(piece_.normals[*at]);
            if (glm::dot(known, normal) > kSameSide) {
                piece_.normals[*at] += normal;
                return *at;
            }
            at = &nextCopy_[*at];
        }
        const auto copy = static_cast<uint32_t>(piece_.vertices.size());
        *at = copy;
        nextCopy_.push_back(kNone);
        piece_.vertices.push_back(asDrawn(vertex));
        piece_.normals.push_back(normal);
        return copy;
    }

private:
    static constexpr uint32_t kNone = ~0u;

    [[nodiscard]] RoomVertex asDrawn(uint32_t vertex) const
    {
        RoomVertex drawn{.position = mesh_.positions[vertex], .colour = mesh_.factor};
        if (!mesh_.colors.empty()) drawn.colour *= mesh_.colors[vertex];
        if (!mesh_.uvs.empty()) {
            drawn.uv = mesh_.uvs[vertex];
        } else {
            const auto width = static_cast<size_t>(page_.width);
            const size_t pixel = mesh_.firstPixel + vertex;
            drawn.uv = {(static_cast<float>(pixel % width) + 0.5f) / static_cast<float>(width),
                        (static_cast<float>(pixel / width) + 0.5f) /
                            static_cast<float>(page_.height)};
        }
        return drawn;
    }

    const relamp::Mesh& mesh_;
    const relamp::Image& page_;
    Piece& piece_;
    std::vector<uint32_t> firstCopy_; // of the mesh's vertices
    std::vector<uint32_t> nextCopy_;  // of the piece's
};

Piece pieceOf(const relamp::Scan& scan, const relamp::Mesh& mesh)
{
    Piece piece;
    Sides sides(mesh, scan.pages[static_cast<size_t>(mesh.page)].image, piece);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        glm::uvec3 triangle;
        for (int k = 0; k < 3; ++k)
            triangle[k] =
                sides.copyOf(mesh.triangles[t][k], mesh.normals[3 * t + static_cast<size_t>(k)]);
        piece.triangles.push_back(triangle);
        for (const auto& [a, b] :
             {std::pair(triangle.x, triangle.y), std::pair(triangle.y, triangle.z),
              std::pair(triangle.z, triangle.x)})
            piece.edges.insert(piece.edges.end(), {a, b});
    }
    return piece;
}

/// Middles of edges that are too long, each made once.
class Middles
{
public:
    Middles(Piece& piece, float longest) : piece_(piece), longestSquared_(longest * longest) {}

    /// The vertex in the middle; kNone where the edge is short enough.
    uint32_t of(uint32_t a, uint32_t b)
    {
        const glm::vec3 way = piece_.vertices[a].position - piece_.vertices[b].position;
        if (glm::dot(way, way) <= longestSquared_) return kNone;
        const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, isNew] = made_.try_emplace(key, 0);
        if (!isNew) return found->second;
        found->second = static_cast<uint32_t>(piece_.vertices.size());
        const RoomVertex& u = piece_.vertices[a];
        const RoomVertex& v = piece_.vertices[b];
        const RoomVertex middle{0.5f * (u.position + v.position), 0.5f * (u.uv + v.uv),
                                0.5f * (u.colour + v.colour)};
        const glm::vec3 normal =
            glm::normalize(piece_.normals[a]) + glm::normalize(piece_.normals[b]);
        piece_.vertices.push_back(middle);
        piece_.normals.push_back(glm::dot(normal, normal) > 0.0f ? normal : piece_.normals[a]);
        return found->second;
    }

    static constexpr uint32_t kNone = ~0u;

private:
    Piece& piece_;
    float longestSquared_;
    std::unordered_map<uint64_t, uint32_t> made_;
};

/// The triangles that one becomes when some of its edges are cut.
void addParts(const glm::uvec3& t, const std::array<uint32_t, 3>& middle,
              std::vector<glm::uvec3>& out)
{
    const int cuts = static_cast<int>(3 - std::count(middle.begin(), middle.end(), Middles::kNone));
    if (cuts == 0) {
        out.push_back(t);
        return;
    }
    if (cuts == 3) {
        out.insert(out.end(),
                   {glm::uvec3(t.x, middle[0], middle[2]), glm::uvec3(middle[0], t.y, middle[1]),
                    glm::uvec3(middle[2], middle[1], t.z),
                    glm::uvec3(middle[0], middle[1], middle[2])});
        return;
    }
    // Turned so that edge 0 is cut; with two cuts, edge 2 is the one that is not.
    size_t first = 0;
    while (middle[first] == Middles::kNone ||
           (cuts == 2 && middle[(first + 1) % 3] == Middles::kNone))
        ++first;
    const auto corner = [&](size_t i) { return t[static_cast<int>((first + i) % 3)]; };
    const uint32_t m = middle[first];
    const uint32_t n = middle[(first + 1) % 3];
    if (cuts == 1) {
        out.insert(out.end(),
                   {glm::uvec3(corner(0), m, corner(2)), glm::uvec3(m, corner(1), corner(2))});
        return;
    }
    out.insert(out.end(), {glm::uvec3(m, corner(1), n), glm::uvec3(corner(0), m, n),
                           glm::uvec3(corner(0), n, corner(2))});
}

void cut(Piece& piece, float longest)
{
    for (int round = 0; round < kMostRounds && piece.vertices.size() < kMostVertices; ++round) {
        Middles middles(piece, longest);
        std::vector<glm::uvec3> parts;
        parts.reserve(piece.triangles.size());
        for (const glm::uvec3& t : piece.triangles) {
            // One after the other: the vertices are numbered by the order in which they are made.
            const uint32_t xy = middles.of(t.x, t.y);
            const uint32_t yz = middles.of(t.y, t.z);
            const uint32_t zx = middles.of(t.z, t.x);
            addParts(t, {xy, yz, zx}, parts);
        }
        const bool isDone = parts.size() == piece.triangles.size();
        piece.triangles = std::move(parts);
        if (isDone) return;
    }
}

void append(const Piece& piece, const relamp::Mesh& mesh, bool ofVertices, RoomMesh& room)
{
    const auto first = static_cast<uint32_t>(room.vertices.size());
    room.surfaces.push_back({static_cast<uint32_t>(room.indices.size()),
                             static_cast<uint32_t>(3 * piece.triangles.size()),
                             static_cast<uint32_t>(room.edges.size()),
                             static_cast<uint32_t>(piece.edges.size()), mesh.page, mesh.wrapU,
                             mesh.wrapV, ofVertices});
    room.vertices.insert(room.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    for (const glm::vec3& normal : piece.normals) room.normals.push_back(glm::normalize(normal));
    for (const uint32_t vertex : piece.edges) room.edges.push_back(first + vertex);
    for (const glm::uvec3& t : piece.triangles)
        room.indices.insert(room.indices.end(), {first + t.x, first + t.y, first + t.z});
}

} // namespace

RoomMesh roomMesh(const relamp::Scan& scan, float longestEdge)
{
    RoomMesh room;
    room.bounds = relamp::boundsOf(scan);
    // Cut triangles are about equilateral: edge^2 / 2.3 each.
    room.longestEdge =
        longestEdge > 0.0f
            ? longestEdge
            : std::max(kFinest, 1.9f * static_cast<float>(std::sqrt(areaOf(scan) / kTriangles)));
    for (const relamp::Mesh& mesh : scan.meshes) {
        const bool ofVertices = scan.pages[static_cast<size_t>(mesh.page)].ofVertices;
        Piece piece = pieceOf(scan, mesh);
        if (!ofVertices) cut(piece, room.longestEdge);
        append(piece, mesh, ofVertices, room);
    }
    return room;
}
