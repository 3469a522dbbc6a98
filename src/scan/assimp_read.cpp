#include "scan/assimp_read.h"

#include "base/fail.h"
#include "scan/assimp_import.h"
#include "scan/finish_mesh.h"
#include "scan/page_builder.h"
#include "scan/scan_frame.h"
#include "scan/scan_textures.h"
#include "scan/take_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

/// Calls `take` with what stands behind `keyword` in each line of a text that begins so.
template<class Take>
void forEachLine(std::span<const std::byte> bytes, std::string_view keyword, const Take& take)
{
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (line.starts_with(keyword)) take(line.substr(keyword.size()));
    }
}

bool holdsFiniteNumbers(std::string_view words)
{
    constexpr std::string_view kSpace = " \t";
    while (!words.empty()) {
        words.remove_prefix(std::min(words.find_first_not_of(kSpace), words.size()));
        const auto number = takeNumber(words);
        if (number && !(std::abs(*number) <= std::numeric_limits<float>::max())) return false;
        words.remove_prefix(std::min(words.find_first_of(kSpace), words.size()));
    }
    return true;
}

/// Refuses texture coordinates of an OBJ that are no finite floats: Assimp takes 0 for them without
/// a word, and so hides them from checkNumbers.
void checkCoordinates(std::span<const std::byte> bytes, const std::string& file)
{
    size_t all = 0;
    size_t bad = 0;
    forEachLine(bytes, "vt ", [&](std::string_view words) {
        ++all;
        if (!holdsFiniteNumbers(words)) ++bad;
    });
    if (bad > 0)
        malformed(file, fmt::format("{} of its {} texture coordinates are not finite numbers.\n"
                                    "Unwrap it again, or export it again.",
                                    bad, all));
}

/// The material file that an OBJ names and that is not there; "" where there is none.
///
/// Assimp passes over it without a word. It also takes the one of the OBJ's own name instead.
std::string missingMaterialFile(std::span<const std::byte> bytes, const std::filesystem::path& obj)
{
    std::string name; // in the first such line
    forEachLine(bytes, "mtllib ", [&](std::string_view words) {
        if (name.empty()) name = words.substr(0, words.find_last_not_of(" \t") + 1);
    });
    std::error_code ignored;
    const bool isThere =
        std::filesystem::exists(obj.parent_path() / name, ignored) ||
        std::filesystem::exists(std::filesystem::path(obj).replace_extension(".mtl"), ignored);
    return isThere ? "" : name;
}

class AssimpReader
{
public:
    AssimpReader(std::span<const std::byte> bytes, const std::filesystem::path& file,
                 const ScanOptions& options)
        : bytes_(bytes), file_(file), options_(options), skipped_(options), textures_(file, options)
    {
        scan_.name = file.stem().string();
        scan_.worldFromFile = worldFromFile(options);
    }

    Scan read(Progress& progress);

private:
    void checkMaterials(const Import& import);
    void takeMesh(Import::Mesh& source, const Import::Material& material);
    void takeColor(Import::Mesh& source, const Import::Material& material, Mesh& mesh);

    std::span<const std::byte> bytes_;
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
    const std::string missing = missingMaterialFile(bytes_, file_);
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
        mesh.colors = std::move(source.colors);
        if (mesh.colors.empty()) mesh.factor = material.diffuse;
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
    Import import = importWithAssimp(file_, options_, progress);
    checkCoordinates(bytes_, file_.string());
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
    scan_.pages = textures_.read(embedded, progress);
    // What these formats keep as bytes a vertex came from a photo, through its transfer curve.
    addVertexPage(scan_, options_.transfer == Transfer::linear ? Transfer::linear : Transfer::srgb,
                  file_.string());
    skipped_.tell(scan_.warnings);
    return std::move(scan_);
}

} // namespace

Scan readWithAssimp(std::span<const std::byte> bytes, const std::filesystem::path& file,
                    const ScanOptions& options, Progress& progress)
{
    return AssimpReader(bytes, file, options).read(progress);
}

} // namespace relamp
