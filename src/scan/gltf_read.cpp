#include "scan/gltf_read.h"

#include "base/fail.h"
#include "base/json.h"
#include "base/parallel.h"
#include "base/spill.h"
#include "scan/finish_mesh.h"
#include "scan/gltf_accessor.h"
#include "scan/gltf_cameras.h"
#include "scan/gltf_json.h"
#include "scan/gltf_material.h"
#include "scan/gltf_mend.h"
#include "scan/gltf_unpack.h"
#include "scan/large_scan.h"
#include "scan/page_builder.h"
#include "scan/scan_frame.h"
#include "scan/scan_limits.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <tiny_gltf.h>

namespace relamp
{
namespace
{

constexpr size_t kLongestName = 200; // of a file, in a message

tinygltf::Model parseModel(const std::string& glb, const std::string& name)
{
    tinygltf::TinyGLTF loader;
    // Pictures stay as they are in the buffer until they are needed; files were fetched before.
    loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    tinygltf::FsCallbacks noFiles{};
    noFiles.FileExists = [](const std::string&, void*) { return false; };
    noFiles.ExpandFilePath = [](const std::string& path, void*) { return path; };
    noFiles.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                               void*) { return false; };
    noFiles.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
    loader.SetFsCallbacks(noFiles);

    tinygltf::Model model;
    std::string failure;
    std::string warning;
    bool read = false;
    try {
        read = loader.LoadBinaryFromMemory(&model, &failure, &warning,
                                           reinterpret_cast<const unsigned char*>(glb.data()),
                                           static_cast<unsigned>(glb.size()));
    } catch (const std::exception&) {
        failure = "a value is of the wrong type"; // its own words would be of C++
    }
    while (failure.ends_with('\n')) failure.pop_back();
    if (!read)
        malformed(name, fmt::format("is not as glTF wants it ({}); export it again", failure));
    return model;
}

glm::mat4 localTransform(const tinygltf::Node& node)
{
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 local(1.0);
    if (node.translation.size() == 3)
        local[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    if (node.rotation.size() == 4) {
        const double* q = node.rotation.data(); // x, y, z, w
        local *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    }
    if (node.scale.size() == 3)
        for (int i = 0; i < 3; ++i) local[i] *= node.scale[static_cast<size_t>(i)];
    return local;
}

/// A triangle list from any of glTF's triangle modes; degenerate ones are left in.
std::vector<glm::uvec3> trianglesFrom(const std::vector<uint32_t>& v, int mode)
{
    std::vector<glm::uvec3> triangles;
    const auto count = static_cast<uint32_t>(v.size());
    if (mode == TINYGLTF_MODE_TRIANGLES)
        for (uint32_t i = 0; i + 2 < count; i += 3)
            triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        for (uint32_t i = 0; i + 2 < count; ++i)
            triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
        for (uint32_t i = 1; i + 1 < count; ++i) triangles.emplace_back(v[0], v[i], v[i + 1]);
    return triangles;
}

class GltfReader
{
public:
    GltfReader(const std::filesystem::path& file, const ScanOptions& options, PlainGltf&& plain)
        : name_(file.string()), options_(options), skipped_(options),
          source_(std::make_shared<GltfSource>()), bytes_(plain.binary.size())
    {
        model_ = parseModel(joinGlb(dumpJson(plain.document), plain.binary), name_);
        source_->document = std::move(plain.document);
        scan_.name = file.stem().string();
        scan_.warnings = std::move(plain.warnings);
    }

    Scan read(Progress& progress);

private:
    /// A primitive at a node.
    struct Placed
    {
        GltfSource::MeshOrigin origin;
        glm::mat4 worldFromLocal;
    };
    void checkAccessors() const;
    void visitScene();
    void visitNode(int index, const glm::mat4& worldFromParent);
    void place(const Placed& placed);
    void count(const tinygltf::Primitive& primitive);
    void takePrimitive(const Placed& placed);
    [[nodiscard]] std::string nameOf(const GltfSource::MeshOrigin& origin) const;
    [[nodiscard]] const tinygltf::Primitive& primitiveOf(const GltfSource::MeshOrigin& origin) const
    {
        return model_.meshes[static_cast<size_t>(origin.mesh)]
            .primitives[static_cast<size_t>(origin.primitive)];
    }
    void takeVertices(const tinygltf::Primitive& primitive, const glm::mat4& worldFromLocal,
                      const std::string& what, Mesh& mesh, std::vector<glm::vec3>& normals) const;
    void takeColor(const tinygltf::Primitive& primitive, const std::string& what, Mesh& mesh);
    int pageOfImage(int image);
    [[nodiscard]] std::string nameOfImage(int image) const // in messages
    {
        return fmt::format("{}: image {} \"{}\"", name_, image,
                           model_.images[static_cast<size_t>(image)].name);
    }
    [[nodiscard]] std::span<const std::byte> bytesOfImage(int image) const;
    void readPages(Progress& progress);

    void keepSource();

    std::string name_;
    const ScanOptions& options_;
    SkippedMeshes skipped_;
    tinygltf::Model model_;
    std::shared_ptr<GltfSource> source_;
    Scan scan_;
    std::vector<uint8_t> visited_; // of nodes
    std::vector<Placed> placed_;
    std::map<int, int> pageOfImage_;
    uint64_t bytes_; // of geometry and pictures, unpacked
    size_t triangles_ = 0;
    size_t vertices_ = 0;
};

int GltfReader::pageOfImage(int image)
{
    const auto [found, isNew] =
        pageOfImage_.try_emplace(image, static_cast<int>(pageOfImage_.size()));
    return found->second;
}

void GltfReader::takeVertices(const tinygltf::Primitive& primitive, const glm::mat4& worldFromLocal,
                              const std::string& what, Mesh& mesh,
                              std::vector<glm::vec3>& normals) const
{
    const auto attribute = [&](const char* key) {
        const auto found = primitive.attributes.find(key);
        return found == primitive.attributes.end() ? -1 : found->second;
    };
    if (attribute("POSITION") < 0) malformed(what, "has no positions");
    const AccessorFloats positions = readFloats(model_, attribute("POSITION"), 3, what);
    mesh.positions.resize(positions.count());
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] =
            worldFromLocal *
            glm::vec4(glm::make_vec3(&positions.values[i * positions.components]), 1.0f);

    const float volume = glm::determinant(glm::mat3(worldFromLocal)); // of the unit cube
    if (attribute("NORMAL") >= 0 && std::isnormal(volume)) {          // flattened, it has none
        const AccessorFloats read = readFloats(model_, attribute("NORMAL"), 3, what);
        const glm::mat3 normalFromLocal = glm::transpose(glm::inverse(glm::mat3(worldFromLocal)));
        normals.resize(read.count());
        for (size_t i = 0; i < normals.size(); ++i)
            normals[i] = normalFromLocal * glm::make_vec3(&read.values[i * read.components]);
    }
    if (attribute("COLOR_0") >= 0) {
        const AccessorFloats read = readFloats(model_, attribute("COLOR_0"), 3, what);
        mesh.colors.resize(read.count());
        for (size_t i = 0; i < mesh.colors.size(); ++i)
            mesh.colors[i] = glm::make_vec3(&read.values[i * read.components]);
    }
    std::vector<uint32_t> indices;
    if (primitive.indices >= 0) {
        indices = readIndices(model_, primitive.indices, what);
    } else {
        indices.resize(mesh.positions.size());
        for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    }
    mesh.triangles = trianglesFrom(indices, primitive.mode);
    if (volume < 0.0f) // a mirrored mesh is wound the other way
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
}

void GltfReader::takeColor(const tinygltf::Primitive& primitive, const std::string& what,
                           Mesh& mesh)
{
    const BaseColor color = baseColorOf(model_, primitive.material, what);
    mesh.factor = color.factor;
    if (color.image < 0) return; // addVertexPage gives it a page
    const std::string set = fmt::format("TEXCOORD_{}", color.texCoord);
    const auto attribute = primitive.attributes.find(set);
    if (attribute == primitive.attributes.end())
        throw Error(
            ErrorCode::unsupported,
            fmt::format("{}: mesh \"{}\" has no texture coordinates ({}).\nUnwrap it first, or "
                        "leave it out with --skip-mesh \"{}\".",
                        name_, mesh.name, set, mesh.name));
    const AccessorFloats uvs = readFloats(model_, attribute->second, 2, what);
    mesh.uvs.resize(uvs.count());
    for (size_t i = 0; i < mesh.uvs.size(); ++i)
        mesh.uvs[i] =
            color.uvFromTexCoord * glm::vec3(glm::make_vec2(&uvs.values[i * uvs.components]), 1.0f);
    mesh.wrapU = color.wrapU;
    mesh.wrapV = color.wrapV;
    mesh.page = pageOfImage(color.image);
}

/// Each is looked through when the scan is written, and many may lie on the same bytes.
void GltfReader::checkAccessors() const
{
    const size_t most = mostOfFile(kMostVertices, bytes_);
    size_t elements = 0;
    for (const tinygltf::Accessor& accessor : model_.accessors) {
        elements += std::min(accessor.count, kMostVertices);
        if (elements > most)
            malformed(name_, fmt::format("its accessors announce more than {} elements, more than "
                                         "a file of its size holds",
                                         most));
    }
}

std::string GltfReader::nameOf(const GltfSource::MeshOrigin& origin) const
{
    const std::string& ofMesh = model_.meshes[static_cast<size_t>(origin.mesh)].name;
    const std::string& ofNode = model_.nodes[static_cast<size_t>(origin.node)].name;
    return !ofMesh.empty()   ? ofMesh
           : !ofNode.empty() ? ofNode
                             : fmt::format("mesh {}", origin.mesh);
}

/// One mesh may stand at many nodes: a small file can hold a scan too large for any machine. To be
/// called before anything of the primitive is read.
void GltfReader::count(const tinygltf::Primitive& primitive)
{
    const auto elementsOf = [&](int accessor) {
        return accessor >= 0 && static_cast<size_t>(accessor) < model_.accessors.size()
                   ? std::min(model_.accessors[static_cast<size_t>(accessor)].count, kMostVertices)
                   : 0;
    };
    const auto positions = primitive.attributes.find("POSITION");
    const size_t vertices =
        positions == primitive.attributes.end() ? 0 : elementsOf(positions->second);
    const size_t corners = primitive.indices >= 0 ? elementsOf(primitive.indices) : vertices;
    triangles_ += primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
    vertices_ += vertices;
    const size_t mostTriangles = mostOfFile(kMostTriangles, bytes_);
    if (triangles_ > mostTriangles)
        malformed(name_, fmt::format("has more than {} triangles, each mesh counted at each of its "
                                     "nodes, more than relamp works on in a file of its size; "
                                     "simplify it",
                                     mostTriangles));
    if (vertices_ > mostOfFile(kMostVertices, bytes_))
        malformed(name_, fmt::format("has more than {} vertices, each mesh counted at each of its "
                                     "nodes, more than relamp works on in a file of its size; "
                                     "simplify it",
                                     mostOfFile(kMostVertices, bytes_)));
    if (placed_.size() >= kMostMeshes)
        malformed(name_, fmt::format("has more than {} meshes, each counted at each of its nodes, "
                                     "more than relamp works on; join them",
                                     kMostMeshes));
}

void GltfReader::place(const Placed& placed)
{
    const std::string name = nameOf(placed.origin);
    if (skipped_.holds(name)) return;
    const tinygltf::Primitive& primitive = primitiveOf(placed.origin);
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        scan_.warnings.push_back(
            fmt::format("mesh \"{}\": points and lines have no surface and were left out", name));
        return;
    }
    count(primitive);
    placed_.push_back(placed);
}

void GltfReader::takePrimitive(const Placed& placed)
{
    const tinygltf::Primitive& primitive = primitiveOf(placed.origin);
    Mesh mesh;
    mesh.name = nameOf(placed.origin);
    const std::string what = fmt::format("{}: mesh \"{}\"", name_, mesh.name);
    std::vector<glm::vec3> normals;
    takeVertices(primitive, placed.worldFromLocal, what, mesh, normals);
    takeColor(primitive, what, mesh);
    finishMesh(mesh, std::move(normals), name_, scan_.warnings);
    if (mesh.triangles.empty()) return;
    scan_.meshes.push_back(std::move(mesh));
    source_->originOfMesh.push_back(placed.origin);
}

void GltfReader::visitNode(int root, const glm::mat4& worldFromParent)
{
    std::vector<std::pair<int, glm::mat4>> open{{root, worldFromParent}};
    while (!open.empty()) {
        const auto [index, worldFromAbove] = open.back();
        open.pop_back();
        if (index < 0 || static_cast<size_t>(index) >= model_.nodes.size())
            malformed(name_, fmt::format("refers to node {}, which is not there", index));
        if (visited_[static_cast<size_t>(index)]++ != 0)
            malformed(name_,
                      fmt::format("node {} is below itself or has two parents; glTF nodes form a "
                                  "tree. Export it again",
                                  index));
        const tinygltf::Node& node = model_.nodes[static_cast<size_t>(index)];
        const glm::mat4 worldFromNode = worldFromAbove * localTransform(node);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.emplace_back(*child, worldFromNode);
        if (const auto camera = cameraAt(model_, node, worldFromNode))
            scan_.cameras.push_back(*camera);
        if (node.mesh < 0) continue;
        if (static_cast<size_t>(node.mesh) >= model_.meshes.size())
            malformed(name_, fmt::format("node {} refers to mesh {}, which is not there", index,
                                         node.mesh));
        if (node.skin >= 0)
            scan_.warnings.push_back(
                fmt::format("node {} is skinned; it is taken in its rest pose", index));
        const size_t primitives = model_.meshes[static_cast<size_t>(node.mesh)].primitives.size();
        for (size_t i = 0; i < primitives; ++i)
            place({{index, node.mesh, static_cast<int>(i)}, worldFromNode});
    }
}

void GltfReader::visitScene()
{
    visited_.assign(model_.nodes.size(), 0);
    if (model_.scenes.empty()) {
        for (const int node : rootNodes(source_->document)) visitNode(node, scan_.worldFromFile);
        return;
    }
    for (const int node :
         model_.scenes.at(static_cast<size_t>(std::max(model_.defaultScene, 0))).nodes)
        visitNode(node, scan_.worldFromFile);
}

std::span<const std::byte> GltfReader::bytesOfImage(int image) const
{
    const tinygltf::Image& source = model_.images[static_cast<size_t>(image)];
    if (source.bufferView < 0)
        malformed(nameOfImage(image),
                  fmt::format("the picture file that it names is missing or unreadable: {}; put it "
                              "beside the file",
                              source.uri.substr(0, kLongestName)));
    const auto& views = model_.bufferViews;
    if (static_cast<size_t>(source.bufferView) >= views.size())
        malformed(nameOfImage(image), "has no content");
    const tinygltf::BufferView& view = views[static_cast<size_t>(source.bufferView)];
    return std::as_bytes(
        std::span(model_.buffers.at(0).data).subspan(view.byteOffset, view.byteLength));
}

void GltfReader::readPages(Progress& progress)
{
    scan_.pages.resize(pageOfImage_.size());
    source_->imageOfPage.resize(scan_.pages.size());
    std::vector<std::pair<int, int>> imageAndPage(pageOfImage_.begin(), pageOfImage_.end());
    uint64_t bytes = 0;
    for (const auto& [image, page] : imageAndPage) bytes += bytesOfImage(image).size();
    PagePixels pixels(scan_.pages.size(), bytes, name_);
    Progress::Stage stage(progress, "read", imageAndPage.size());
    forEach(imageAndPage.size(), [&](size_t i) {
        const auto [image, index] = imageAndPage[i];
        const std::string& name = model_.images[static_cast<size_t>(image)].name;
        Page& page = scan_.pages[static_cast<size_t>(index)];
        page.name = !name.empty() ? name : fmt::format("image {}", image);
        page.image = readImage(bytesOfImage(image), nameOfImage(image), options_.transfer);
        if (pixels.add(page.image.pixels()) > pixelsInMemory()) spillPage(page);
        source_->imageOfPage[static_cast<size_t>(index)] = image;
        stage.advance();
    });
}

void GltfReader::keepSource()
{
    source_->imageOfPage.resize(scan_.pages.size(), -1);
    for (int t = 0; t < static_cast<int>(model_.textures.size()); ++t)
        source_->imageOfTexture.push_back(findImage(model_, t));
    mendAccessors(model_, source_->document);
    if (!model_.buffers.empty()) source_->binary = std::move(model_.buffers[0].data);
    if (isLarge(scan_)) spill(source_->binary); // of which most are the pictures
    scan_.gltf = std::move(source_);
}

Scan GltfReader::read(Progress& progress)
{
    scan_.worldFromFile = worldFromFile(options_);
    checkAccessors();
    visitScene();
    for (const Placed& placed : placed_) takePrimitive(placed);
    readPages(progress);
    addVertexPage(scan_, options_.transfer, name_);
    skipped_.tell(scan_.warnings);
    keepSource();
    return std::move(scan_);
}

} // namespace

std::vector<int> rootNodes(const nlohmann::json& document)
{
    const auto nodes = document.find("nodes");
    std::vector<uint8_t> isChild(nodes == document.end() ? 0 : nodes->size(), 0);
    for (size_t i = 0; i < isChild.size(); ++i)
        for (const nlohmann::json& child : (*nodes)[i].value("children", nlohmann::json::array()))
            if (child.is_number_unsigned() && child.get<size_t>() < isChild.size())
                isChild[child.get<size_t>()] = 1;
    std::vector<int> roots;
    for (size_t i = 0; i < isChild.size(); ++i)
        if (isChild[i] == 0) roots.push_back(static_cast<int>(i));
    return roots;
}

Scan readGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
              const ScanOptions& options, Progress& progress)
{
    return GltfReader(file, options, unpackGltf(bytes, file, options)).read(progress);
}

} // namespace relamp
