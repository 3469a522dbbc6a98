#include "scan/gltf_material.h"

#include "base/fail.h"

#include <cmath>

#include <fmt/format.h>

namespace relamp
{
namespace
{

using tinygltf::Value;

const Value* extensionOf(const tinygltf::ExtensionMap& extensions, const char* name)
{
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

float numberAt(const Value& array, int i, float fallback)
{
    return array.IsArray() ? static_cast<float>(array.Get(i).GetNumberAsDouble()) : fallback;
}

/// KHR_texture_transform: scale, then rotation, then offset.
glm::mat3 uvTransformOf(const Value& extension)
{
    const Value& offset = extension.Get("offset");
    const Value& scale = extension.Get("scale");
    const Value& rotation = extension.Get("rotation");
    const double angle = rotation.IsNumber() ? rotation.GetNumberAsDouble() : 0.0;
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    const float sx = numberAt(scale, 0, 1.0f);
    const float sy = numberAt(scale, 1, 1.0f);
    return {{c * sx, -s * sx, 0.0f},
            {s * sy, c * sy, 0.0f},
            {numberAt(offset, 0, 0.0f), numberAt(offset, 1, 0.0f), 1.0f}};
}

Wrap wrapFrom(int gltfWrap)
{
    if (gltfWrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    if (gltfWrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
    return Wrap::repeat;
}

void takeTexture(const tinygltf::Model& model, int texture,
                 const tinygltf::ExtensionMap& extensions, const std::string& what,
                 BaseColor& color)
{
    color.image = imageOfTexture(model, texture, what);
    const int sampler = model.textures[static_cast<size_t>(texture)].sampler;
    if (sampler >= 0 && static_cast<size_t>(sampler) < model.samplers.size()) {
        color.wrapU = wrapFrom(model.samplers[static_cast<size_t>(sampler)].wrapS);
        color.wrapV = wrapFrom(model.samplers[static_cast<size_t>(sampler)].wrapT);
    }
    if (const Value* transform = extensionOf(extensions, "KHR_texture_transform")) {
        color.uvFromTexCoord = uvTransformOf(*transform);
        if (transform->Get("texCoord").IsInt())
            color.texCoord = transform->Get("texCoord").Get<int>();
    }
}

void takeSpecularGlossiness(const tinygltf::Model& model, const Value& extension,
                            const std::string& what, BaseColor& color)
{
    const Value& factor = extension.Get("diffuseFactor");
    for (int c = 0; c < 3; ++c) color.factor[c] = numberAt(factor, c, 1.0f);
    const Value& texture = extension.Get("diffuseTexture");
    if (!texture.IsObject() || !texture.Get("index").IsInt()) return;
    if (texture.Get("texCoord").IsInt()) color.texCoord = texture.Get("texCoord").Get<int>();
    tinygltf::ExtensionMap extensions;
    if (texture.Get("extensions").IsObject())
        extensions = texture.Get("extensions").Get<Value::Object>();
    takeTexture(model, texture.Get("index").Get<int>(), extensions, what, color);
}

} // namespace

int findImage(const tinygltf::Model& model, int texture)
{
    if (texture < 0 || static_cast<size_t>(texture) >= model.textures.size()) return -1;
    const tinygltf::Texture& found = model.textures[static_cast<size_t>(texture)];
    int image = found.source;
    if (const Value* webp = extensionOf(found.extensions, "EXT_texture_webp"))
        if (webp->Get("source").IsInt()) image = webp->Get("source").Get<int>();
    return image >= 0 && static_cast<size_t>(image) < model.images.size() ? image : -1;
}

int imageOfTexture(const tinygltf::Model& model, int texture, const std::string& what)
{
    if (const int image = findImage(model, texture); image >= 0) return image;
    if (texture < 0 || static_cast<size_t>(texture) >= model.textures.size())
        malformed(what, fmt::format("refers to texture {}, which is not there", texture));
    const tinygltf::Texture& found = model.textures[static_cast<size_t>(texture)];
    if (extensionOf(found.extensions, "KHR_texture_basisu") != nullptr)
        fail(
            ErrorCode::unsupported, what,
            "its texture is in KTX2 / Basis Universal, which relamp does not read.\nExport it with "
            "JPEG or PNG textures, or convert it, for which KTX-Software has to be installed:\n"
            "npx @gltf-transform/cli ktxdecompress in.glb out.glb");
    malformed(what, fmt::format("its texture {} refers to image {}, which is not there", texture,
                                found.source));
}

BaseColor baseColorOf(const tinygltf::Model& model, int material, const std::string& what)
{
    BaseColor color;
    if (material < 0) return color;
    if (static_cast<size_t>(material) >= model.materials.size())
        malformed(what, fmt::format("refers to material {}, which is not there", material));
    const tinygltf::Material& found = model.materials[static_cast<size_t>(material)];
    const tinygltf::PbrMetallicRoughness& pbr = found.pbrMetallicRoughness;
    for (size_t c = 0; c < 3; ++c)
        color.factor[static_cast<int>(c)] = static_cast<float>(pbr.baseColorFactor.at(c));
    if (pbr.baseColorTexture.index >= 0) {
        color.texCoord = pbr.baseColorTexture.texCoord;
        takeTexture(model, pbr.baseColorTexture.index, pbr.baseColorTexture.extensions, what,
                    color);
    } else if (const Value* glossiness =
                   extensionOf(found.extensions, "KHR_materials_pbrSpecularGlossiness")) {
        takeSpecularGlossiness(model, *glossiness, what, color);
    }
    return color;
}

} // namespace relamp
