#include "scan/ply_read.h"

#include "base/fail.h"
#include "scan/finish_mesh.h"
#include "scan/page_builder.h"
#include "scan/ply_file.h"
#include "scan/scan_frame.h"
#include "scan/scan_limits.h"
#include "scan/scan_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include <meshoptimizer.h>

namespace relamp
{
namespace
{

/// What relamp takes of a vertex, and where it goes.
enum Slot : size_t { x, y, z, nx, ny, nz, red, green, blue, u, v, kSlots };

constexpr std::array<std::array<std::string_view, 3>, kSlots> kNames{
    {{"x"},
     {"y"},
     {"z"},
     {"nx"},
     {"ny"},
     {"nz"},
     {"red", "r", "diffuse_red"},
     {"green", "g", "diffuse_green"},
     {"blue", "b", "diffuse_blue"},
     {"u", "s", "texture_u"},
     {"v", "t", "texture_v"}}};

size_t slotOf(const PlyProperty& property)
{
    const auto isName = [&](const auto& names) {
        return std::find(names.begin(), names.end(), property.name) != names.end();
    };
    if (property.countType) return kSlots;
    return static_cast<size_t>(std::find_if(kNames.begin(), kNames.end(), isName) - kNames.begin());
}

/// A corner of a triangle, where faces have texture coordinates of their own.
struct Corner
{
    uint32_t vertex;
    glm::vec2 uv;
};

/// Triangles that show one picture.
struct Part
{
    uint32_t texture;
    std::vector<glm::uvec3> triangles; // of vertices
    std::vector<Corner> corners;       // three a triangle, or none
};

uint32_t indexFrom(double value)
{
    const bool isIndex =
        value >= 0.0 && value < std::numeric_limits<uint32_t>::max() && std::trunc(value) == value;
    return isIndex ? static_cast<uint32_t>(value) : std::numeric_limits<uint32_t>::max();
}

/// Of any of its lists of faces; then the corners of all are kept.
bool facesHaveCoordinates(const PlyHeader& header)
{
    const auto isCoordinates = [](const PlyProperty& property) {
        return property.name == "texcoord";
    };
    return std::any_of(
        header.elements.begin(), header.elements.end(), [&](const PlyElement& element) {
            return element.name == "face" &&
                   std::any_of(element.properties.begin(), element.properties.end(), isCoordinates);
        });
}

/// Whether faces or vertices have any.
bool hasCoordinates(const PlyHeader& header)
{
    return facesHaveCoordinates(header) ||
           std::any_of(
               header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
                   return element.name == "vertex" &&
                          std::any_of(element.properties.begin(), element.properties.end(),
                                      [](const auto& property) { return slotOf(property) == u; });
               });
}

class PlyReader
{
public:
    PlyReader(std::span<const std::byte> bytes, const std::filesystem::path& file,
              const ScanOptions& options)
        : name_(file.string()), options_(options), skipped_(options),
          header_(parsePlyHeader(bytes, name_)),
          body_(bytes.subspan(header_.size), header_.encoding, name_), textures_(file, options),
          hasCornerUvs_(facesHaveCoordinates(header_)),
          hasCoordinates_(!header_.textureFiles.empty() && hasCoordinates(header_))
    {
        scan_.name = file.stem().string();
        scan_.worldFromFile = worldFromFile(options);
    }

    Scan read(Progress& progress);

private:
    void takeVertices(const PlyElement& element);
    void takeVertex(const std::array<double, kSlots>& row, const std::array<bool, kSlots>& has);
    void takeFaces(const PlyElement& element);
    void takePolygon(const std::vector<double>& vertices, const std::vector<double>& uvs,
                     uint32_t texture);
    void skip(const PlyElement& element);
    Part& partOf(uint32_t texture);
    void takeOwnVertices(const Part& part, Mesh& mesh, std::vector<glm::vec3>& normals);
    void finish(Part& part);
    int pageOf(const Part& part);
    void splitAtSeams(const Part& part, Mesh& mesh, std::vector<glm::vec3>& normals) const;
    void checkIndices(const Part& part) const;
    void checkColors() const;

    std::string name_;
    const ScanOptions& options_;
    SkippedMeshes skipped_;
    PlyHeader header_;
    PlyBody body_;
    ScanTextures textures_;
    Scan scan_;
    Mesh vertices_; // positions, uvs and colours, no triangles
    std::vector<glm::vec3> normals_;
    std::vector<Part> parts_;
    std::map<uint32_t, size_t> partOfTexture_; // of these
    std::vector<uint32_t> newIndex_;           // of vertices; while a part takes its own
    bool hasCornerUvs_;
    bool hasCoordinates_; // and pictures
};

void PlyReader::takeVertex(const std::array<double, kSlots>& row,
                           const std::array<bool, kSlots>& has)
{
    const auto vector = [&](size_t first) {
        return glm::vec3(glm::dvec3(row[first], row[first + 1], row[first + 2]));
    };
    vertices_.positions.emplace_back(scan_.worldFromFile * glm::vec4(vector(x), 1.0f));
    if (has[nx] && has[ny] && has[nz])
        normals_.push_back(glm::mat3(scan_.worldFromFile) * vector(nx));
    if (has[u] && has[v]) vertices_.uvs.emplace_back(row[u], 1.0 - row[v]); // PLY's v points up
    if (has[red] && has[green] && has[blue]) vertices_.colors.push_back(vector(red));
}

void PlyReader::takeVertices(const PlyElement& element)
{
    std::vector<size_t> slots;
    std::array<bool, kSlots> has{};
    for (const PlyProperty& property : element.properties) {
        slots.push_back(slotOf(property));
        if (slots.back() < kSlots) has[slots.back()] = true;
    }
    if (!has[x] || !has[y] || !has[z]) malformed(name_, "its vertices have no x, y and z");
    std::vector<double> values;
    for (uint64_t i = 0; i < element.count; ++i) {
        std::array<double, kSlots> row{};
        for (size_t p = 0; p < slots.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            body_.next(property, values);
            if (slots[p] >= kSlots) continue;
            const bool isColor = slots[p] == red || slots[p] == green || slots[p] == blue;
            row[slots[p]] = isColor ? values[0] / largestOf(property.type) : values[0];
        }
        takeVertex(row, has);
    }
}

Part& PlyReader::partOf(uint32_t texture)
{
    const auto [found, isNew] = partOfTexture_.try_emplace(texture, parts_.size());
    return isNew ? parts_.emplace_back(Part{texture, {}, {}}) : parts_[found->second];
}

void PlyReader::takePolygon(const std::vector<double>& vertices, const std::vector<double>& uvs,
                            uint32_t texture)
{
    Part& part = partOf(texture);
    const auto corner = [&](size_t i) {
        const bool known = uvs.size() >= 2 * vertices.size();
        return Corner{indexFrom(vertices[i]),
                      known ? glm::vec2(uvs[2 * i], 1.0 - uvs[2 * i + 1]) : glm::vec2(0.0f)};
    };
    for (size_t i = 1; i + 1 < vertices.size(); ++i) {
        const std::array<Corner, 3> corners{corner(0), corner(i), corner(i + 1)};
        part.triangles.emplace_back(corners[0].vertex, corners[1].vertex, corners[2].vertex);
        if (hasCornerUvs_) part.corners.insert(part.corners.end(), corners.begin(), corners.end());
    }
}

void PlyReader::takeFaces(const PlyElement& element)
{
    std::vector<double> vertices;
    std::vector<double> uvs;
    std::vector<double> other;
    for (uint64_t i = 0; i < element.count; ++i) {
        uint32_t texture = 0;
        for (const PlyProperty& property : element.properties) {
            const bool isVertices =
                property.name == "vertex_indices" || property.name == "vertex_index";
            std::vector<double>& values = isVertices                    ? vertices
                                          : property.name == "texcoord" ? uvs
                                                                        : other;
            body_.next(property, values);
            if (property.name == "texnumber" && !values.empty()) texture = indexFrom(values[0]);
        }
        if (texture >= kMostPages) texture = 0; // -1 says that a face has none
        if (!hasCoordinates_) texture = 0;      // no picture can be shown
        takePolygon(vertices, uvs, texture);
    }
}

void PlyReader::skip(const PlyElement& element)
{
    std::vector<double> values;
    if (element.properties.empty()) return;
    for (uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) body_.next(property, values);
}

/// Gives each pair of vertex and texture coordinate a vertex of its own.
void PlyReader::splitAtSeams(const Part& part, Mesh& mesh, std::vector<glm::vec3>& normals) const
{
    std::vector<uint32_t> vertexOf(part.corners.size());
    const size_t count =
        meshopt_generateVertexRemap(vertexOf.data(), nullptr, part.corners.size(),
                                    part.corners.data(), part.corners.size(), sizeof(Corner));
    mesh.positions.resize(count);
    mesh.uvs.resize(count);
    normals.resize(normals_.empty() ? 0 : count);
    for (size_t i = 0; i < part.corners.size(); ++i) {
        const auto [vertex, uv] = part.corners[i];
        mesh.positions[vertexOf[i]] = vertices_.positions[vertex];
        mesh.uvs[vertexOf[i]] = uv;
        if (!normals.empty()) normals[vertexOf[i]] = normals_[vertex];
    }
    mesh.triangles.resize(part.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangles[i] = {vertexOf[3 * i], vertexOf[3 * i + 1], vertexOf[3 * i + 2]};
}

int PlyReader::pageOf(const Part& part)
{
    if (part.texture >= header_.textureFiles.size())
        malformed(name_, fmt::format("its faces show texture {}, and its header names {}",
                                     part.texture, header_.textureFiles.size()));
    return textures_.pageOf(header_.textureFiles[part.texture], "its header");
}

void PlyReader::checkIndices(const Part& part) const
{
    for (const glm::uvec3& t : part.triangles)
        if (const uint32_t last = std::max({t.x, t.y, t.z}); last >= vertices_.positions.size())
            malformed(
                name_,
                fmt::format(
                    "refers to vertex {}, and it has {}; the file is damaged, export it again",
                    last, vertices_.positions.size()));
}

void PlyReader::checkColors() const
{
    const bool hasUvs = hasCornerUvs_ || !vertices_.uvs.empty();
    const bool hasPictures = !header_.textureFiles.empty();
    if (!vertices_.colors.empty() || hasUvs == hasPictures) return;
    if (hasUvs)
        fail(ErrorCode::unsupported, name_,
             "has texture coordinates but names no picture.\nAdd the line \"comment TextureFile "
             "picture.jpg\" to its "
             "header, behind the format.");
    fail(ErrorCode::unsupported, name_,
         "names a picture but has no texture coordinates.\nUnwrap it first.");
}

/// Those that its triangles use, in the order of the file: every part may use but a few of all.
void PlyReader::takeOwnVertices(const Part& part, Mesh& mesh, std::vector<glm::vec3>& normals)
{
    std::vector<uint32_t> own;
    for (const glm::uvec3& t : part.triangles) own.insert(own.end(), {t.x, t.y, t.z});
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    newIndex_.resize(vertices_.positions.size());
    for (const uint32_t vertex : own) {
        newIndex_[vertex] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(vertices_.positions[vertex]);
        mesh.uvs.push_back(vertices_.uvs[vertex]);
        if (!normals_.empty()) normals.push_back(normals_[vertex]);
    }
    for (const glm::uvec3& t : part.triangles)
        mesh.triangles.emplace_back(newIndex_[t.x], newIndex_[t.y], newIndex_[t.z]);
}

void PlyReader::finish(Part& part)
{
    Mesh mesh;
    mesh.name = parts_.size() == 1 ? scan_.name : fmt::format("{} {}", scan_.name, part.texture);
    if (skipped_.holds(mesh.name)) return;
    checkIndices(part);
    const bool hasPictures = !header_.textureFiles.empty();
    std::vector<glm::vec3> normals;
    if (hasPictures && hasCornerUvs_) {
        splitAtSeams(part, mesh, normals);
        mesh.page = pageOf(part);
    } else if (hasPictures && !vertices_.uvs.empty()) {
        takeOwnVertices(part, mesh, normals);
        mesh.page = pageOf(part);
    } else { // all, in the order of the file
        mesh.positions = vertices_.positions;
        mesh.triangles = std::move(part.triangles);
        normals = normals_;
        mesh.colors = vertices_.colors;
    }
    finishMesh(mesh, std::move(normals), name_, scan_.warnings);
    if (!mesh.triangles.empty()) scan_.meshes.push_back(std::move(mesh));
}

Scan PlyReader::read(Progress& progress)
{
    for (const PlyElement& element : header_.elements) {
        progress.check();
        body_.expect(element);
        if (element.name == "vertex")
            takeVertices(element);
        else if (element.name == "face")
            takeFaces(element);
        else
            skip(element);
    }
    body_.expectEnd();
    if (parts_.empty())
        fail(ErrorCode::unsupported, name_,
             fmt::format("has {} points but no faces: it is a point cloud, and relamp needs a "
                         "surface.\nMake a mesh "
                         "of it first, for example with MeshLab.",
                         vertices_.positions.size()));
    checkColors();
    for (Part& part : parts_) finish(part);
    scan_.pages = textures_.read({}, progress);
    // What PLY keeps as bytes a vertex came from a photo, through its transfer curve.
    addVertexPage(scan_, options_.transfer == Transfer::linear ? Transfer::linear : Transfer::srgb,
                  name_);
    skipped_.tell(scan_.warnings);
    return std::move(scan_);
}

} // namespace

bool isPly(std::span<const std::byte> bytes)
{
    return bytes.size() >= 4 && bytes[0] == std::byte('p') && bytes[1] == std::byte('l') &&
           bytes[2] == std::byte('y') &&
           (bytes[3] == std::byte('\n') || bytes[3] == std::byte('\r'));
}

Scan readPly(std::span<const std::byte> bytes, const std::filesystem::path& file,
             const ScanOptions& options, Progress& progress)
{
    return PlyReader(bytes, file, options).read(progress);
}

} // namespace relamp
