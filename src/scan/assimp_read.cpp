#include "scan/assimp_read.h"

#include "base/file.h"
#include "base/parallel.h"
#include "relamp/error.h"
#include "scan/finish_mesh.h"
#include "scan/page_builder.h"
#include "scan/scan_frame.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

constexpr int kDeepestNode = 1000;

glm::vec3 from(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

glm::mat4 from(const aiMatrix4x4& m) // Assimp is row-major
{
    return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

float finiteColor(float v)
{
    return std::isfinite(v) ? std::max(v, 0.0f) : 0.0f;
}

Wrap wrapFrom(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return Wrap::clamp;
    if (mode == aiTextureMapMode_Mirror) return Wrap::mirror;
    return Wrap::repeat;
}

class AssimpReader
{
public:
    AssimpReader(const std::filesystem::path& file, const ScanOptions& options)
        : file_(file), options_(options)
    {
        scan_.name = file.stem().string();
    }

    Scan read(Progress& progress);

private:
    void visitNode(const aiNode& node, const glm::mat4& worldFromParent, int depth);
    void takeMesh(const aiMesh& source, const std::string& nodeName, const glm::mat4& worldFromLocal);
    void takeVertices(const aiMesh& source, const glm::mat4& worldFromLocal, Mesh& mesh,
                      std::vector<glm::vec3>& normals) const;
    void takeColor(const aiMesh& source, Mesh& mesh);
    [[nodiscard]] std::filesystem::path findTexture(const std::string& name,
                                                    const std::string& material) const;
    void readPages(Progress& progress);

    std::filesystem::path file_;
    const ScanOptions& options_;
    Assimp::Importer importer_;
    const aiScene* scene_ = nullptr;
    Scan scan_;
    std::map<std::string, int> pageOfTexture_;
    std::map<int, std::string> materialOfPage_;
};

void AssimpReader::takeVertices(const aiMesh& source, const glm::mat4& worldFromLocal, Mesh& mesh,
                                std::vector<glm::vec3>& normals) const
{
    const glm::mat3 normalFromLocal = glm::transpose(glm::inverse(glm::mat3(worldFromLocal)));
    mesh.positions.resize(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i)
        mesh.positions[i] = worldFromLocal * glm::vec4(from(source.mVertices[i]), 1.0f);
    if (source.HasNormals()) {
        normals.resize(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i)
            normals[i] = normalFromLocal * from(source.mNormals[i]);
    }
    if (source.HasVertexColors(0)) {
        mesh.colors.resize(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumVertices; ++i) {
            const aiColor4D& color = source.mColors[0][i];
            mesh.colors[i] = {finiteColor(color.r), finiteColor(color.g), finiteColor(color.b)};
        }
    }
    const bool mirrored = glm::determinant(glm::mat3(worldFromLocal)) < 0.0f;
    mesh.triangles.reserve(source.mNumFaces);
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices != 3) continue;
        const unsigned* v = face.mIndices;
        mesh.triangles.push_back(mirrored ? glm::uvec3(v[0], v[2], v[1]) : glm::uvec3(v[0], v[1], v[2]));
    }
}

std::filesystem::path AssimpReader::findTexture(const std::string& name, const std::string& material) const
{
    std::string path = name;
    std::replace(path.begin(), path.end(), '\\', '/');
    const std::filesystem::path relative(path);
    const std::filesystem::path beside = file_.parent_path();
    for (const auto& candidate : {beside / relative, beside / relative.filename()})
        if (std::filesystem::is_regular_file(candidate)) return candidate;
    throw Error(ErrorCode::cannotRead,
                fmt::format("{}: material \"{}\" names the texture \"{}\", which is not there.\nPut it "
                            "beside the file, or correct the name in the material.",
                            file_.string(), material, name));
}

void AssimpReader::takeColor(const aiMesh& source, Mesh& mesh)
{
    const aiMaterial& material = *scene_->mMaterials[source.mMaterialIndex];
    aiString texture;
    aiTextureMapMode mode[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned set = 0;
    bool found = false;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
        found = found || material.GetTexture(type, 0, &texture, nullptr, &set, nullptr, nullptr, mode) ==
                             aiReturn_SUCCESS;
    if (!found) {
        aiColor3D diffuse(1.0f, 1.0f, 1.0f);
        if (mesh.colors.empty() && material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == aiReturn_SUCCESS)
            mesh.factor = {finiteColor(diffuse.r), finiteColor(diffuse.g), finiteColor(diffuse.b)};
        return;
    }
    if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !source.HasTextureCoords(set))
        throw Error(ErrorCode::unsupported,
                    fmt::format("{}: mesh \"{}\" has a texture but no texture coordinates.\nUnwrap it "
                                "first, or leave it out with --skip-mesh \"{}\".",
                                file_.string(), mesh.name, mesh.name));
    mesh.uvs.resize(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i)
        mesh.uvs[i] = glm::vec2(from(source.mTextureCoords[set][i]));
    mesh.wrapU = wrapFrom(mode[0]);
    mesh.wrapV = wrapFrom(mode[1]);
    mesh.colors.clear(); // a photo already is the colour
    const auto next = static_cast<int>(pageOfTexture_.size());
    mesh.page = pageOfTexture_.try_emplace(texture.C_Str(), next).first->second;
    materialOfPage_.try_emplace(mesh.page, material.GetName().C_Str());
}

void AssimpReader::takeMesh(const aiMesh& source, const std::string& nodeName,
                            const glm::mat4& worldFromLocal)
{
    Mesh mesh;
    mesh.name = source.mName.length > 0 ? source.mName.C_Str() : nodeName;
    if (isSkipped(options_, mesh.name)) return;
    std::vector<glm::vec3> normals;
    takeVertices(source, worldFromLocal, mesh, normals);
    takeColor(source, mesh);
    finishMesh(mesh, normals, file_.string(), scan_.warnings);
    if (!mesh.triangles.empty()) scan_.meshes.push_back(std::move(mesh));
}

void AssimpReader::visitNode(const aiNode& node, const glm::mat4& worldFromParent, int depth)
{
    if (depth > kDeepestNode)
        throw Error(ErrorCode::malformed, fmt::format("{}: its nodes are nested without end", file_.string()));
    const glm::mat4 worldFromNode = worldFromParent * from(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        takeMesh(*scene_->mMeshes[node.mMeshes[i]], node.mName.C_Str(), worldFromNode);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        visitNode(*node.mChildren[i], worldFromNode, depth + 1);
}

void AssimpReader::readPages(Progress& progress)
{
    scan_.pages.resize(pageOfTexture_.size());
    const std::vector<std::pair<std::string, int>> textures(pageOfTexture_.begin(), pageOfTexture_.end());
    Progress::Stage stage(progress, "read", textures.size());
    forEach(textures.size(), [&](size_t i) {
        const auto& [name, index] = textures[i];
        Page& page = scan_.pages[static_cast<size_t>(index)];
        page.name = name;
        if (const aiTexture* embedded = scene_->GetEmbeddedTexture(name.c_str())) {
            const std::string what = fmt::format("{}: texture \"{}\"", file_.string(), name);
            if (embedded->mHeight != 0)
                throw Error(ErrorCode::unsupported, what + ": is stored raw, which relamp does not read");
            page.image = readImage(std::as_bytes(std::span(reinterpret_cast<const char*>(embedded->pcData),
                                                           embedded->mWidth)),
                                   what, options_.transfer);
        } else {
            page.image = readImage(findTexture(name, materialOfPage_[index]), options_.transfer);
        }
        stage.advance();
    });
}

Scan AssimpReader::read(Progress& progress)
{
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    scene_ = importer_.ReadFile(file_.string(), aiProcess_Triangulate | aiProcess_SortByPType |
                                                    aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs |
                                                    aiProcess_ValidateDataStructure);
    if (scene_ == nullptr || scene_->mRootNode == nullptr)
        throw Error(ErrorCode::malformed,
                    fmt::format("{}: cannot be read: {}", file_.string(), importer_.GetErrorString()));
    scan_.worldFromFile = worldFromFile(options_);
    visitNode(*scene_->mRootNode, scan_.worldFromFile, 0);
    readPages(progress);
    // What these formats keep as bytes a vertex came from a photo, through its transfer curve.
    addVertexPage(scan_, options_.transfer == Transfer::linear ? Transfer::linear : Transfer::srgb,
                  file_.string());
    return std::move(scan_);
}

} // namespace

Scan readWithAssimp(const std::filesystem::path& file, const ScanOptions& options, Progress& progress)
{
    return AssimpReader(file, options).read(progress);
}

} // namespace relamp
