#include "scan/gltf_write.h"

#include "base/fail.h"
#include "base/json.h"
#include "relamp/version.h"
#include "scan/gltf_from_scan.h"
#include "scan/gltf_json.h"
#include "scan/gltf_lights.h"
#include "scan/gltf_read.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <span>

namespace relamp
{
namespace
{

using nlohmann::json;
using Content = std::span<const uint8_t>;

constexpr size_t kLargestGlb = (size_t{1} << 32) - (size_t{1} << 20);

void eraseExtension(json& object, const char* name)
{
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) return;
    extensions->erase(name);
    if (extensions->empty()) object.erase("extensions");
}

/// Edits a copy of the document that a scan came from.
class GlbWriter
{
public:
    GlbWriter(const Scan& scan, const std::vector<RelitPage>& pages)
        : scan_(scan), pages_(pages),
          source_(scan.gltf ? scan.gltf : std::make_shared<const GltfSource>(gltfFromScan(scan))),
          document_(source_->document), origins_(source_->originOfMesh)
    {
        for (const json& view : section("bufferViews"))
            contentOfView_.push_back(Content(source_->binary)
                                         .subspan(view.value("byteOffset", size_t{0}),
                                                  view["byteLength"].get<size_t>()));
    }

    std::string write(const Lights& lights);
    std::string writeUnlit();

private:
    json& section(const char* key);
    size_t append(const char* sectionKey, json item);
    size_t addView(Content content);
    json& primitiveOf(size_t mesh);
    [[nodiscard]] const Page& pageOf(size_t mesh) const;
    [[nodiscard]] bool isPage(int image) const;
    [[nodiscard]] bool showsPage(const json& textureInfo) const;

    void separateInstances();
    void separateOthers();
    void keepPhotos(json& material);
    size_t textureOfPhoto(size_t texture);
    void replaceImages();
    void replaceTextureSources();
    void replaceContent();
    void relightMaterials();
    void makeUnlit();
    void relightMaterial(json& material) const;
    void setEmission(json& material, size_t page);
    void replaceVertexColors();
    void dropUnusedExtensions();
    void sign(json told);
    std::string assemble();

    const Scan& scan_;
    const std::vector<RelitPage>& pages_;
    std::shared_ptr<const GltfSource> source_;
    json document_;
    std::vector<GltfSource::MeshOrigin> origins_;
    std::vector<Content> contentOfView_;
    std::map<size_t, size_t> emissionTextureOfPage_;
    std::map<size_t, size_t> photoOfTexture_; // for what is left out of the scan
};

json& GlbWriter::section(const char* key)
{
    json& list = document_[key];
    if (list.is_null()) list = json::array();
    return list;
}

size_t GlbWriter::append(const char* sectionKey, json item)
{
    json& list = section(sectionKey);
    list.push_back(std::move(item));
    return list.size() - 1;
}

size_t GlbWriter::addView(Content content)
{
    contentOfView_.push_back(content);
    return append("bufferViews", {{"buffer", 0}});
}

json& GlbWriter::primitiveOf(size_t mesh)
{
    const GltfSource::MeshOrigin& origin = origins_[mesh];
    return document_["meshes"][static_cast<size_t>(origin.mesh)]["primitives"]
                    [static_cast<size_t>(origin.primitive)];
}

const Page& GlbWriter::pageOf(size_t mesh) const
{
    return scan_.pages[static_cast<size_t>(scan_.meshes[mesh].page)];
}

bool GlbWriter::isPage(int image) const
{
    const auto& images = source_->imageOfPage;
    return image >= 0 && std::find(images.begin(), images.end(), image) != images.end();
}

bool GlbWriter::showsPage(const json& textureInfo) const
{
    const size_t texture = textureInfo.value("index", source_->imageOfTexture.size());
    return texture < source_->imageOfTexture.size() && isPage(source_->imageOfTexture[texture]);
}

/// A mesh that stands at several nodes has another light, and so other vertex colours, at each.
void GlbWriter::separateInstances()
{
    std::set<int> colored; // meshes of which a primitive is coloured by its vertices
    for (size_t m = 0; m < scan_.meshes.size(); ++m)
        if (pageOf(m).ofVertices) colored.insert(origins_[m].mesh);
    std::map<int, int> ownerOf;                 // mesh -> node that keeps it
    std::map<std::pair<int, int>, int> copyFor; // mesh and another node -> its copy
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        GltfSource::MeshOrigin& origin = origins_[m];
        if (!colored.contains(origin.mesh) ||
            ownerOf.try_emplace(origin.mesh, origin.node).first->second == origin.node)
            continue;
        const auto [copy, isNew] = copyFor.try_emplace({origin.mesh, origin.node}, -1);
        if (isNew)
            copy->second = static_cast<int>(
                append("meshes", section("meshes")[static_cast<size_t>(origin.mesh)]));
        document_["nodes"][static_cast<size_t>(origin.node)]["mesh"] = copy->second;
        origin.mesh = copy->second;
    }
}

/// What was left out of the scan, say with --skip-mesh, stays as it came: of materials and pictures
/// that it shares with the scan it gets its own.
void GlbWriter::separateOthers()
{
    std::set<std::pair<int, int>> ours; // mesh and primitive
    std::set<size_t> relit;             // materials
    for (size_t m = 0; m < origins_.size(); ++m) {
        ours.emplace(origins_[m].mesh, origins_[m].primitive);
        relit.insert(primitiveOf(m).value("material", ~size_t{0}));
    }
    std::map<size_t, size_t> ownMaterial; // of the others, by what they came with
    json& meshes = section("meshes");
    for (size_t mesh = 0; mesh < meshes.size(); ++mesh) {
        json& primitives = meshes[mesh]["primitives"];
        for (size_t i = 0; i < primitives.size(); ++i) {
            const size_t material = primitives[i].value("material", ~size_t{0});
            if (ours.contains({static_cast<int>(mesh), static_cast<int>(i)}) ||
                material >= section("materials").size())
                continue;
            const auto [own, isNew] = ownMaterial.try_emplace(material, material);
            if (isNew && relit.contains(material))
                own->second = append("materials", section("materials")[material]);
            if (isNew) keepPhotos(section("materials")[own->second]);
            primitives[i]["material"] = own->second;
        }
    }
}

/// Lets all textures of a material show the pictures that pages came with.
void GlbWriter::keepPhotos(json& material)
{
    for (const auto& [key, value] : material.items()) {
        if (!value.is_object() || key == "extras") continue;
        if (key.ends_with("Texture") && showsPage(value))
            value["index"] = textureOfPhoto(value["index"].get<size_t>());
        else
            keepPhotos(value);
    }
}

/// A copy of a page's texture; its image still has the old content when the page's is replaced.
size_t GlbWriter::textureOfPhoto(size_t texture)
{
    const auto [found, isNew] = photoOfTexture_.try_emplace(texture, 0);
    if (!isNew) return found->second;
    const int image = source_->imageOfTexture[texture];
    const size_t photo = append("images", section("images")[static_cast<size_t>(image)]);
    json copy = section("textures")[texture];
    if (copy.value("source", -1) == image) copy["source"] = photo;
    const json extensions = copy.value("extensions", json::object());
    for (const auto& [name, extension] : extensions.items())
        if (extension.value("source", -1) == image) copy["extensions"][name]["source"] = photo;
    return found->second = append("textures", std::move(copy));
}

void GlbWriter::replaceImages()
{
    json& images = section("images");
    for (size_t p = 0; p < pages_.size(); ++p) {
        const int index = source_->imageOfPage[p];
        if (index < 0) continue;
        json& image = images[static_cast<size_t>(index)];
        const EncodedImage& albedo = pages_[p].albedo;
        image["mimeType"] = albedo.mimeType;
        const json view = image.value("bufferView", json());
        const auto showsSame = [&](const json& other) {
            return other.value("bufferView", json()) == view;
        };
        if (!view.is_null() && std::count_if(images.begin(), images.end(), showsSame) == 1)
            contentOfView_[view.get<size_t>()] = albedo.bytes; // so that nothing else is renumbered
        else
            image["bufferView"] = addView(albedo.bytes);
    }
}

/// A page's texture may have named the photo in other formats besides; there is one picture now.
void GlbWriter::replaceTextureSources()
{
    json& textures = section("textures");
    for (size_t t = 0; t < source_->imageOfTexture.size(); ++t) {
        json& texture = textures[t];
        if (!isPage(source_->imageOfTexture[t])) continue;
        texture["source"] = source_->imageOfTexture[t];
        const json extensions = texture.value("extensions", json::object());
        for (const auto& [name, extension] : extensions.items())
            if (extension.contains("source")) eraseExtension(texture, name.c_str());
    }
}

void GlbWriter::setEmission(json& material, size_t page)
{
    const EncodedImage& emission = pages_[page].emission;
    if (emission.bytes.empty()) return;
    const json& base = material["pbrMetallicRoughness"]["baseColorTexture"];
    const auto [found, isNew] = emissionTextureOfPage_.try_emplace(page, 0);
    if (isNew) {
        json texture{{"source", append("images", {{"name", scan_.pages[page].name + " emission"},
                                                  {"mimeType", emission.mimeType},
                                                  {"bufferView", addView(emission.bytes)}})}};
        const json& old = section("textures").at(base["index"].get<size_t>());
        if (old.contains("sampler")) texture["sampler"] = old["sampler"];
        found->second = append("textures", std::move(texture));
    }
    material["emissiveTexture"] = base; // the same coordinates, under the same transform
    material["emissiveTexture"]["index"] = found->second;
    material["emissiveFactor"] = {1.0, 1.0, 1.0};
    eraseExtension(material, "KHR_materials_emissive_strength");
}

void GlbWriter::relightMaterial(json& material) const
{
    json& pbr = material["pbrMetallicRoughness"];
    if (pbr.is_null()) pbr = json::object();
    const json glossiness = material.value(
        "/extensions/KHR_materials_pbrSpecularGlossiness"_json_pointer, json::object());
    if (!pbr.contains("baseColorTexture") && glossiness.contains("diffuseTexture"))
        pbr["baseColorTexture"] = glossiness["diffuseTexture"];
    eraseExtension(material, "KHR_materials_pbrSpecularGlossiness");
    eraseExtension(material, "KHR_materials_unlit"); // an unlit surface could not be relit
    if (showsPage(material.value("emissiveTexture",
                                 json::object()))) { // the photo as a glow: unlit, the old way
        material.erase("emissiveTexture");
        material.erase("emissiveFactor");
    }
    const json factor = pbr.value("baseColorFactor", json::array());
    pbr.erase("baseColorFactor"); // it is in the albedo now, but for the opacity
    if (factor.size() == 4 && factor[3] != 1.0) pbr["baseColorFactor"] = {1.0, 1.0, 1.0, factor[3]};
    if (pbr.contains("metallicRoughnessTexture")) return;
    pbr["metallicFactor"] = 0.0;
    pbr["roughnessFactor"] = 1.0;
}

void GlbWriter::relightMaterials()
{
    std::map<size_t, size_t> pageOfMaterial;
    json plain; // glTF's default material is a metal
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        json& primitive = primitiveOf(m);
        if (!primitive.contains("material")) {
            if (plain.is_null()) plain = append("materials", json::object());
            primitive["material"] = plain;
        }
        pageOfMaterial.try_emplace(primitive["material"].get<size_t>(),
                                   static_cast<size_t>(scan_.meshes[m].page));
    }
    for (const auto& [index, page] : pageOfMaterial) {
        json& material = section("materials").at(index);
        relightMaterial(material);
        setEmission(material, page);
    }
}

/// Vertices that are a page show their albedo; on other meshes the albedo has the vertex colours in
/// it.
void GlbWriter::replaceVertexColors()
{
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        const Mesh& mesh = scan_.meshes[m];
        json& attributes = primitiveOf(m)["attributes"];
        attributes.erase("COLOR_0");
        if (!pageOf(m).ofVertices) continue;
        const std::span all(pages_[static_cast<size_t>(mesh.page)].vertexAlbedo);
        const auto albedo =
            std::as_bytes(all.subspan(3 * mesh.firstPixel, 3 * mesh.positions.size()));
        const size_t view =
            addView({reinterpret_cast<const uint8_t*>(albedo.data()), albedo.size()});
        section("bufferViews")[view]["target"] = kArrayBuffer;
        attributes["COLOR_0"] = append("accessors", {{"bufferView", view},
                                                     {"componentType", kFloat},
                                                     {"type", "VEC3"},
                                                     {"count", mesh.positions.size()}});
    }
}

void GlbWriter::dropUnusedExtensions()
{
    constexpr std::array kOurs{"KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness",
                               "EXT_texture_webp",    "KHR_materials_emissive_strength",
                               "KHR_texture_basisu",  "EXT_texture_avif",
                               "MSFT_texture_dds"};
    const auto isUsed = [&](const char* key, const std::string& extension) {
        const json& things = section(key);
        return std::any_of(things.begin(), things.end(), [&](const json& thing) {
            return thing.value("extensions", json::object()).contains(extension);
        });
    };
    const auto isUnused = [&](const json& extension) {
        return std::find(kOurs.begin(), kOurs.end(), extension) != kOurs.end() &&
               !isUsed("materials", extension) && !isUsed("textures", extension);
    };
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        json& names = section(key);
        names.erase(std::remove_if(names.begin(), names.end(), isUnused), names.end());
    }
}

/// Lays out what buffer views still show: the old pictures stay behind.
std::string GlbWriter::assemble()
{
    std::vector<uint8_t> binary;
    std::map<std::pair<const uint8_t*, size_t>, size_t> placed;
    json& views = section("bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
        const Content content = contentOfView_[i];
        const auto [found, isNew] = placed.try_emplace({content.data(), content.size()}, 0);
        if (isNew) {
            binary.resize((binary.size() + 15) / 16 * 16);
            found->second = binary.size();
            if (binary.size() + content.size() > kLargestGlb)
                fail(ErrorCode::unsupported, scan_.title(),
                     "its GLB would exceed 4 GiB; scale the textures down");
            binary.insert(binary.end(), content.begin(), content.end());
        }
        views[i]["byteOffset"] = found->second;
        views[i]["byteLength"] = content.size();
    }
    document_["buffers"] = {{{"byteLength", binary.size()}}};
    for (const char* key : {"images", "textures", "extensionsUsed", "extensionsRequired"})
        if (section(key).empty()) document_.erase(key);
    return joinGlb(dumpJson(document_), binary);
}

/// Pages, colours and materials as `pages_` wants them.
void GlbWriter::replaceContent()
{
    separateInstances();
    separateOthers();
    replaceImages();
    replaceTextureSources();
    relightMaterials();
    replaceVertexColors();
}

void GlbWriter::makeUnlit()
{
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        json& material = section("materials").at(primitiveOf(m)["material"].get<size_t>());
        material["extensions"]["KHR_materials_unlit"] = json::object();
        material.erase("emissiveTexture"); // the light is in the base colour
        material.erase("emissiveFactor");
    }
    json& used = section("extensionsUsed");
    if (std::find(used.begin(), used.end(), "KHR_materials_unlit") == used.end())
        used.push_back("KHR_materials_unlit");
}

/// Says who wrote the file and what `told` tells of it, and keeps what the scanner said of itself.
void GlbWriter::sign(json told)
{
    json& asset = document_["asset"];
    json& extras = asset["extras"];
    if (!extras.is_object()) extras = json::object();
    const json former = extras.value(kSignature, json::object());
    const char* const key = "scanGenerator";
    if (former.is_object() && former.contains(key))
        told[key] = former[key];
    else if (asset.contains("generator"))
        told[key] = asset["generator"];
    extras[kSignature] = std::move(told);
    asset["generator"] = std::string("relamp ") + version();
}

std::string GlbWriter::write(const Lights& lights)
{
    replaceContent();
    const ScanOptions frame =
        scan_.gltf ? scan_.options : ScanOptions{}; // of other formats: the world's
    sign({{"textures", "albedo"},
          {"up", frame.up == UpAxis::z ? "z" : "y"},
          {"scale", frame.scale},
          {"lights", json::parse(lightsAsJson(lights))}});
    addLights(document_, lights, scan_.gltf ? scan_.worldFromFile : glm::mat4(1.0f));
    dropUnusedExtensions();
    return assemble();
}

std::string GlbWriter::writeUnlit()
{
    replaceContent();
    sign({{"textures", "light"}});
    makeUnlit();
    dropUnusedExtensions();
    return assemble();
}

} // namespace

std::string writeGlb(const Scan& scan, const std::vector<RelitPage>& pages, const Lights& lights)
{
    return GlbWriter(scan, pages).write(lights);
}

std::string writeUnlitGlb(const Scan& scan, const std::vector<RelitPage>& pages)
{
    return GlbWriter(scan, pages).writeUnlit();
}

} // namespace relamp
