#include "scan/assimp_read.h"

#include "base/fail.h"
#include "base/file.h"
#include "scan/assimp_import.h"
#include "scan/finish_mesh.h"
#include "scan/page_builder.h"
#include "scan/scan_frame.h"
#include "scan/scan_textures.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

glm::vec3 finiteColor(const glm::vec3& color)
{
    const auto finite = [](float v) { return std::isfinite(v) ? std::max(v, 0.0f) : 0.0f; };
    return {finite(color.r), finite(color.g), finite(color.b)};
}

/// The material file that an OBJ names and that is not there; "" where there is none.
///
/// Assimp passes over it without a word. It also takes the one of the OBJ's own name instead.
std::string missingMaterialFile(const std::filesystem::path& obj)
{
    const std::vector<std::byte> bytes = readFile(obj);
    std::istringstream lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    constexpr std::string_view kKeyword = "mtllib ";
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(kKeyword)) continue;
        const std::string name =
            line.substr(kKeyword.size(), line.find_last_not_of(" \t\r") + 1 - kKeyword.size());
        std::error_code ignored;
        const bool isThere =
            std::filesystem::exists(obj.parent_path() / name, ignored) ||
            std::filesystem::exists(std::filesystem::path(obj).replace_extension(".mtl"), ignored);
        return isThere ? "" : name;
    }
    return "";
}

class AssimpReader
{
public:
    AssimpReader(const std::filesystem::path& file, const ScanOptions& options)
        : file_(file), options_(options), skipped_(options), textures_(file)
    {
        scan_.name = file.stem().string();
        scan_.worldFromFile = worldFromFile(options);
    }

    Scan read(Progress& progress);

private:
    void checkMaterials(const Import& import);
    void takeMesh(Import::Mesh& source, const Import::Material& material);
    void takeColor(Import::Mesh& source, const Import::Material& material, Mesh& mesh);

    std::filesystem::path file_;
    const ScanOptions& options_;
    SkippedMeshes skipped_;
    ScanTextures textures_;
    Scan scan_;
};

void AssimpReader::checkMaterials(const Import& import)
{
    const auto hasTexture = [](const Import::Material& material) {
        return !material.texture.empty();
    };
    const auto hasColors = [](const Import::Mesh& mesh) { return !mesh.colors.empty(); };
    if (std::any_of(import.materials.begin(), import.materials.end(), hasTexture)) return;
    const std::string missing = missingMaterialFile(file_);
    if (missing.empty()) return;
    const std::string sentence = fmt::format(
        "names the material file \"{}\", which is not there, and so has no texture", missing);
    if (std::none_of(import.meshes.begin(), import.meshes.end(), hasColors))
        fail(ErrorCode::cannotRead, file_.string(),
             sentence + ".\nPut it beside the file, with its pictures.");
    scan_.warnings.push_back("it " + sentence + "; its vertex colours were taken");
}

void AssimpReader::takeColor(Import::Mesh& source, const Import::Material& material, Mesh& mesh)
{
    if (material.texture.empty()) {
        for (const glm::vec3& color : source.colors) mesh.colors.push_back(finiteColor(color));
        if (mesh.colors.empty()) mesh.factor = finiteColor(material.diffuse);
        return;
    }
    if (source.uvs.empty())
        fail(ErrorCode::unsupported, file_.string(),
             fmt::format("mesh \"{0}\" has a texture but no texture coordinates.\nUnwrap it first, "
                         "or leave it "
                         "out with --skip-mesh \"{0}\".",
                         mesh.name));
    mesh.uvs = std::move(source.uvs); // and no colours: a photo already is the colour
    mesh.wrapU = material.wrapU;
    mesh.wrapV = material.wrapV;
    mesh.page = textures_.pageOf(material.texture, fmt::format("material \"{}\"", material.name));
}

void AssimpReader::takeMesh(Import::Mesh& source, const Import::Material& material)
{
    Mesh mesh;
    mesh.name = source.name;
    if (skipped_.holds(mesh.name)) return;
    for (const glm::vec3& p : source.positions)
        mesh.positions.emplace_back(scan_.worldFromFile * glm::vec4(p, 1.0f));
    std::vector<glm::vec3> normals;
    for (const glm::vec3& n : source.normals) normals.push_back(glm::mat3(scan_.worldFromFile) * n);
    mesh.triangles = std::move(source.triangles);
    takeColor(source, material, mesh);
    finishMesh(mesh, std::move(normals), file_.string(), scan_.warnings);
    if (!mesh.triangles.empty()) scan_.meshes.push_back(std::move(mesh));
}

Scan AssimpReader::read(Progress& progress)
{
    Import import = importWithAssimp(file_, progress);
    checkMaterials(import);
    for (Import::Mesh& mesh : import.meshes) {
        progress.check();
        if (mesh.material >= import.materials.size())
            malformed(file_.string(), "names a material that is not there");
        takeMesh(mesh, import.materials[mesh.material]);
    }
    std::map<std::string, std::vector<std::byte>> embedded;
    for (Import::Texture& texture : import.textures)
        embedded[texture.name] = std::move(texture.bytes);
    scan_.pages = textures_.read(embedded, options_.transfer, progress);
    // What these formats keep as bytes a vertex came from a photo, through its transfer curve.
    addVertexPage(scan_, options_.transfer == Transfer::linear ? Transfer::linear : Transfer::srgb,
                  file_.string());
    skipped_.tell(scan_.warnings);
    return std::move(scan_);
}

} // namespace

Scan readWithAssimp(const std::filesystem::path& file, const ScanOptions& options,
                    Progress& progress)
{
    return AssimpReader(file, options).read(progress);
}

} // namespace relamp
