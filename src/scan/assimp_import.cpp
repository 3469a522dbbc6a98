#include "scan/assimp_import.h"

#include "base/child_process.h"
#include "base/fail.h"
#include "scan/scan_folder.h"

#include <cmath>
#include <cstring>
#include <exception>
#include <span>
#include <type_traits>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Exceptional.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

constexpr int kDeepestNode = 1000;
// Measured on OBJ and FBX files of 100 MB: 15 bytes of memory and 0.1 us a byte.
constexpr size_t kMemoryPerByte = 64;
constexpr double kSecondsPerByte = 1e-6;

// ---- from Assimp's structures, in the child

glm::vec3 from(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

glm::mat4 from(const aiMatrix4x4& m) // Assimp is row-major
{
    return {{m.a1, m.b1, m.c1, m.d1},
            {m.a2, m.b2, m.c2, m.d2},
            {m.a3, m.b3, m.c3, m.d3},
            {m.a4, m.b4, m.c4, m.d4}};
}

Wrap from(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return Wrap::clamp;
    if (mode == aiTextureMapMode_Mirror) return Wrap::mirror;
    return Wrap::repeat;
}

std::string nameOf(const aiTexture& embedded, int index)
{
    return embedded.mFilename.length > 0 ? embedded.mFilename.C_Str() : fmt::format("*{}", index);
}

/// A name as some programs write it into an MTL: in quotes, or with spaces behind it.
std::string bare(std::string name)
{
    const size_t last = name.find_last_not_of(" \t\"");
    name.erase(last == std::string::npos ? 0 : last + 1);
    name.erase(0, name.find_first_not_of(" \t\""));
    return name;
}

class SceneReader
{
public:
    explicit SceneReader(const aiScene& scene) : scene_(scene) {}

    Import read()
    {
        for (unsigned i = 0; i < scene_.mNumMaterials; ++i) takeMaterial(*scene_.mMaterials[i]);
        visitNode(*scene_.mRootNode, glm::mat4(1.0f), 0);
        for (unsigned i = 0; i < scene_.mNumTextures; ++i)
            takeTexture(*scene_.mTextures[i], static_cast<int>(i));
        return std::move(import_);
    }

private:
    void takeMaterial(const aiMaterial& source);
    void takeTexture(const aiTexture& source, int index);
    void takeMesh(const aiMesh& source, const std::string& nodeName,
                  const glm::mat4& fileFromLocal);
    void visitNode(const aiNode& node, const glm::mat4& fileFromParent, int depth);

    const aiScene& scene_;
    Import import_;
    std::vector<unsigned> uvSetOfMaterial_;
};

void SceneReader::takeMaterial(const aiMaterial& source)
{
    Import::Material material;
    material.name = source.GetName().C_Str();
    aiString texture;
    aiTextureMapMode mode[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned uvSet = 0;
    bool found = false;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
        found = found || source.GetTexture(type, 0, &texture, nullptr, &uvSet, nullptr, nullptr,
                                           mode) == aiReturn_SUCCESS;
    if (found) material.texture = bare(texture.C_Str());
    const auto [embedded, index] = scene_.GetEmbeddedTextureAndIndex(texture.C_Str());
    if (found && embedded != nullptr) material.texture = nameOf(*embedded, index);
    material.wrapU = from(mode[0]);
    material.wrapV = from(mode[1]);
    aiColor3D diffuse(1.0f, 1.0f, 1.0f);
    source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    material.diffuse = {diffuse.r, diffuse.g, diffuse.b};
    import_.materials.push_back(std::move(material));
    uvSetOfMaterial_.push_back(uvSet);
}

void SceneReader::takeTexture(const aiTexture& source, int index)
{
    Import::Texture texture;
    texture.name = nameOf(source, index);
    if (source.mHeight == 0) { // else raw pixels, which no format that a scan comes in has
        const auto* bytes = reinterpret_cast<const std::byte*>(source.pcData);
        texture.bytes.assign(bytes, bytes + source.mWidth);
    }
    import_.textures.push_back(std::move(texture));
}

void SceneReader::takeMesh(const aiMesh& source, const std::string& nodeName,
                           const glm::mat4& fileFromLocal)
{
    Import::Mesh mesh;
    mesh.name = source.mName.length > 0 ? source.mName.C_Str() : nodeName;
    mesh.material = source.mMaterialIndex;
    const float volume = glm::determinant(glm::mat3(fileFromLocal));      // of the unit cube
    const bool hasNormals = source.HasNormals() && std::isnormal(volume); // flattened, it has none
    const glm::mat3 normalFromLocal = glm::transpose(glm::inverse(glm::mat3(fileFromLocal)));
    const unsigned uvSet = uvSetOfMaterial_.at(source.mMaterialIndex);
    const bool hasUvs = uvSet < AI_MAX_NUMBER_OF_TEXTURECOORDS && source.HasTextureCoords(uvSet);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        mesh.positions.emplace_back(fileFromLocal * glm::vec4(from(source.mVertices[i]), 1.0f));
        if (hasNormals) mesh.normals.push_back(normalFromLocal * from(source.mNormals[i]));
        if (hasUvs) mesh.uvs.emplace_back(from(source.mTextureCoords[uvSet][i]));
        if (!source.HasVertexColors(0)) continue;
        const aiColor4D& color = source.mColors[0][i];
        mesh.colors.emplace_back(color.r, color.g, color.b);
    }
    const bool mirrored = volume < 0.0f;
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices != 3) continue;
        const unsigned* v = face.mIndices;
        mesh.triangles.push_back(mirrored ? glm::uvec3(v[0], v[2], v[1])
                                          : glm::uvec3(v[0], v[1], v[2]));
    }
    import_.meshes.push_back(std::move(mesh));
}

void SceneReader::visitNode(const aiNode& node, const glm::mat4& fileFromParent, int depth)
{
    if (depth > kDeepestNode) throw std::runtime_error("nodes without end");
    const glm::mat4 fileFromNode = fileFromParent * from(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        takeMesh(*scene_.mMeshes[node.mMeshes[i]], node.mName.C_Str(), fileFromNode);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        visitNode(*node.mChildren[i], fileFromNode, depth + 1);
}

// ---- through the pipe

/// Shows `visit` every value of an Import: one order for writing and for reading.
template<class Visit>
void visitAll(auto& import, const Visit& visit)
{
    visit.list(import.materials, [&](auto& material) {
        visit.values(material.name);
        visit.values(material.texture);
        visit.value(material.wrapU);
        visit.value(material.wrapV);
        visit.value(material.diffuse);
    });
    visit.list(import.meshes, [&](auto& mesh) {
        visit.values(mesh.name);
        visit.value(mesh.material);
        visit.values(mesh.positions);
        visit.values(mesh.normals);
        visit.values(mesh.colors);
        visit.values(mesh.uvs);
        visit.values(mesh.triangles);
    });
    visit.list(import.textures, [&](auto& texture) {
        visit.values(texture.name);
        visit.values(texture.bytes);
    });
}

struct Packer
{
    std::vector<std::byte>& bytes;

    template<class Value>
    void value(const Value& v) const
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        const auto* first = reinterpret_cast<const std::byte*>(&v);
        bytes.insert(bytes.end(), first, first + sizeof v);
    }
    template<class Container>
    void values(const Container& container) const
    {
        value(uint64_t{container.size()});
        const auto content = std::as_bytes(std::span(container));
        bytes.insert(bytes.end(), content.begin(), content.end());
    }
    template<class Item, class Take>
    void list(const std::vector<Item>& items, const Take& take) const
    {
        value(uint64_t{items.size()});
        for (const Item& item : items) take(item);
    }
};

/// Trusts the other side as little as the file: it may have been overrun before it wrote.
struct RequestUnpacker
{
    std::span<const std::byte>& bytes;

    template<class Value>
    void value(Value& v) const
    {
        take(&v, 1, sizeof v);
    }
    template<class Container>
    void values(Container& container) const
    {
        container.resize(length(sizeof container[0]));
        take(container.data(), container.size(), sizeof container[0]);
    }
    template<class Item, class Take>
    void list(std::vector<Item>& items, const Take& takeItem) const
    {
        items.resize(length(sizeof(uint64_t)));
        for (Item& item : items) takeItem(item);
    }

private:
    [[nodiscard]] uint64_t length(size_t leastSize) const
    {
        uint64_t count = 0;
        value(count);
        if (count > bytes.size() / leastSize) throw std::length_error("broken answer");
        return count;
    }
    void take(void* target, size_t count, size_t size) const
    {
        if (count * size > bytes.size()) throw std::length_error("broken answer");
        if (count == 0) return; // and `target` may be null
        std::memcpy(target, bytes.data(), count * size);
        bytes = bytes.subspan(count * size);
    }
};

/// The files that Assimp opens beside the one that it was given: materials, animations, parts.
class FilesOfFolder : public Assimp::DefaultIOSystem
{
public:
    explicit FilesOfFolder(const ScanFolder& folder) : folder_(folder) {}

    Assimp::IOStream* Open(const char* file, const char* mode) override
    {
        if (folder_.holds(file)) return DefaultIOSystem::Open(file, mode);
        if (DefaultIOSystem::Exists(file)) refused_ = file;
        return nullptr;
    }
    bool Exists(const char* file) const override
    {
        return folder_.holds(file) && DefaultIOSystem::Exists(file);
    }
    /// One that is there, and was not opened; empty: none.
    [[nodiscard]] const std::string& refused() const { return refused_; }

private:
    const ScanFolder& folder_;
    std::string refused_;
};

/// Why it failed; what other libraries throw within Assimp is about C++, not about the file.
std::string reasonOf(const Assimp::Importer& importer)
{
    try {
        if (importer.GetException()) std::rethrow_exception(importer.GetException());
    } catch (const DeadlyErrorBase&) {
    } catch (...) {
        return "the library that knows this format fails on it";
    }
    return importer.GetErrorString();
}

std::vector<std::byte> importAndPack(const std::filesystem::path& file, const ScanFolder& folder)
{
    Assimp::Importer importer;
    auto* files = new FilesOfFolder(folder); // NOLINT(cppcoreguidelines-owning-memory)
    importer.SetIOHandler(files);            // which is the importer's from now on
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene =
        importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType |
                                             aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs |
                                             aiProcess_ValidateDataStructure);
    if (!files->refused().empty()) ScanFolder::refuse(file.string() + ": it", files->refused());
    if (scene == nullptr || scene->mRootNode == nullptr)
        malformed(file.string(),
                  fmt::format("cannot be read: {}\nExport it again, as GLB, OBJ or PLY",
                              reasonOf(importer)));
    const Import import = SceneReader(*scene).read();
    std::vector<std::byte> bytes;
    visitAll(import, Packer{bytes});
    return bytes;
}

} // namespace

Import importWithAssimp(const std::filesystem::path& file, const ScanOptions& options,
                        const Progress& progress)
{
    const ScanFolder folder(file, options);
    const auto size = std::filesystem::file_size(file);
    ChildLimits limits;
    limits.memory += kMemoryPerByte * size;
    limits.seconds = 4.0 + kSecondsPerByte * static_cast<double>(size);
    std::vector<std::byte> bytes;
    runInChild([&](const ByteSink& send) { send(importAndPack(file, folder)); },
               [&](std::span<const std::byte> piece) {
                   bytes.insert(bytes.end(), piece.begin(), piece.end());
               },
               limits, {file.string(), "The file is damaged; export it again, best as GLB"},
               progress);
    Import import;
    std::span<const std::byte> rest(bytes);
    try {
        visitAll(import, RequestUnpacker{rest});
    } catch (const std::length_error&) {
        malformed(file.string(), "cannot be read: the library that knows this format fails on it");
    }
    return import;
}

} // namespace relamp
