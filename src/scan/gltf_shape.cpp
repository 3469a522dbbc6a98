#include "scan/gltf_shape.h"

#include "base/fail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr uint64_t kMostBytes = uint64_t{1} << 53; // beyond, numbers of JSON are not exact
constexpr uint64_t kLargestIndex = std::numeric_limits<int32_t>::max();
constexpr double kBrightestFactor = 65504.0; // the largest half float, as which light is kept

/// A member of an item, as a message names it.
struct Place
{
    const std::string& file;
    const char* item; // "node"; null: of the document itself
    size_t index;
    const char* key;
    bool isEach = false; // of what the member holds

    [[nodiscard]] Place each() const { return {file, item, index, key, true}; }
    [[noreturn]] void fail(const std::string& wanted) const
    {
        const std::string what =
            item != nullptr ? fmt::format("{}: {} {}", file, item, index) : file;
        malformed(what, fmt::format("{}\"{}\" must be {}; export it again",
                                    isEach ? "each of " : "", key, wanted));
    }
};

using Check = void (*)(json& value, const Place& place);

struct Rule
{
    const char* key;
    Check check;
    bool isRequired = false;
};

constexpr bool kRequired = true;

// ---- values

void text(json& value, const Place& place)
{
    if (!value.is_string()) place.fail("a text");
}

void flag(json& value, const Place& place)
{
    if (!value.is_boolean()) place.fail("true or false");
}

void number(json& value, const Place& place)
{
    if (!value.is_number()) place.fail("a number");
}

/// A whole number that some programs write as 4.0.
template<uint64_t least, uint64_t most>
void whole(json& value, const Place& place)
{
    if (value.is_number_float() && value >= 0.0 && value <= static_cast<double>(most) &&
        std::trunc(value.get<double>()) == value.get<double>())
        value = static_cast<uint64_t>(value.get<double>());
    if (!value.is_number_unsigned() || value < least || value > most)
        place.fail(fmt::format("a whole number from {} to {}", least, most));
}

constexpr Check bytes = whole<0, kMostBytes>;
constexpr Check index = whole<0, kLargestIndex>; // of an item of a list

void stride(json& value, const Place& place)
{
    whole<4, 252>(value, place);
    if (value.get<uint64_t>() % 4 != 0) place.fail("a multiple of 4");
}

template<const auto& allowed>
void oneOf(json& value, const Place& place)
{
    const auto isSame = [&](const auto& item) { return value == item; };
    if (std::any_of(allowed.begin(), allowed.end(), isSame)) return;
    std::string list;
    for (const auto& item : allowed) list += fmt::format("{}{}", list.empty() ? "" : ", ", item);
    place.fail("one of " + list);
}

constexpr std::array kComponentTypes{5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array kElementTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::array kWraps{10497, 33071, 33648};

// ---- lists

template<Check check>
void listOf(json& value, const Place& place)
{
    if (!value.is_array()) place.fail("a list");
    for (json& item : value) check(item, place.each());
}

template<size_t count>
void numbers(json& value, const Place& place)
{
    const auto isNumber = [](const json& item) { return item.is_number(); };
    if (!value.is_array() || value.size() != count ||
        !std::all_of(value.begin(), value.end(), isNumber))
        place.fail(fmt::format("a list of {} numbers", count));
}

/// A turn: of four zeros there is no unit quaternion.
void quaternion(json& value, const Place& place)
{
    numbers<4>(value, place);
    if (std::all_of(value.begin(), value.end(), [](const json& item) { return item == 0.0; }))
        place.fail("a turn, not four zeros");
}

void color(json& value, const Place& place)
{
    numbers<4>(value, place);
    for (const json& item : value)
        if (item < 0.0 || item > kBrightestFactor)
            place.fail(fmt::format("4 numbers from 0 to {}", kBrightestFactor));
}

// ---- objects

void object(json& value, const Place& place)
{
    if (!value.is_object()) place.fail("an object");
}

template<Check check>
void mapOf(json& value, const Place& place)
{
    object(value, place);
    for (json& member : value) check(member, place.each());
}

template<const auto& rules>
void objectOf(json& value, const Place& place)
{
    object(value, place);
    for (const Rule& rule : rules) {
        const Place member{place.file, place.item, place.index, rule.key};
        const auto found = value.find(rule.key);
        if (found != value.end())
            rule.check(*found, member);
        else if (rule.isRequired)
            member.fail("there");
    }
}

/// Extensions, of which those of `rules` are known.
template<const auto& rules>
void extensionsOf(json& value, const Place& place)
{
    mapOf<object>(value, place);
    objectOf<rules>(value, place);
}

constexpr std::array kTransform{
    Rule{"offset", numbers<2>},
    Rule{"scale", numbers<2>},
    Rule{"rotation", number},
    Rule{"texCoord", index},
};
constexpr std::array kTextureInfoExtensions{Rule{"KHR_texture_transform", objectOf<kTransform>}};
constexpr std::array kTextureInfo{
    Rule{"index", index, kRequired},
    Rule{"texCoord", index},
    Rule{"extensions", extensionsOf<kTextureInfoExtensions>},
};

/// Whatever extension it belongs to, "...Texture" names a texture.
void texturesWithin(json& value, const Place& place)
{
    if (!value.is_object()) return;
    for (auto& [key, member] : value.items()) {
        if (key == "extras") continue;
        const bool isTexture = key.ends_with("Texture");
        isTexture
            ? objectOf<kTextureInfo>(member, {place.file, place.item, place.index, key.c_str()})
            : texturesWithin(member, place);
    }
}

// ---- items

constexpr std::array kBuffer{
    Rule{"uri", text},
    Rule{"byteLength", bytes, kRequired},
};

constexpr std::array kMeshopt{
    Rule{"buffer", index, kRequired},
    Rule{"byteOffset", bytes},
    Rule{"byteLength", bytes, kRequired},
    Rule{"byteStride", bytes, kRequired},
    Rule{"count", bytes, kRequired},
    Rule{"mode", text, kRequired},
    Rule{"filter", text},
};
constexpr std::array kViewExtensions{Rule{"EXT_meshopt_compression", objectOf<kMeshopt>}};
constexpr std::array kView{
    Rule{"buffer", index, kRequired},
    Rule{"byteOffset", bytes},
    Rule{"byteLength", bytes, kRequired},
    Rule{"byteStride", stride},
    Rule{"target", index},
    Rule{"name", text},
    Rule{"extensions", extensionsOf<kViewExtensions>},
};

constexpr std::array kSparseIndices{
    Rule{"bufferView", index, kRequired},
    Rule{"byteOffset", index},
    Rule{"componentType", oneOf<kComponentTypes>, kRequired},
};
constexpr std::array kSparseValues{
    Rule{"bufferView", index, kRequired},
    Rule{"byteOffset", index},
};
constexpr std::array kSparse{
    Rule{"count", index, kRequired},
    Rule{"indices", objectOf<kSparseIndices>, kRequired},
    Rule{"values", objectOf<kSparseValues>, kRequired},
};
constexpr std::array kAccessor{
    Rule{"bufferView", index},
    Rule{"byteOffset", bytes},
    Rule{"componentType", oneOf<kComponentTypes>, kRequired},
    Rule{"count", bytes, kRequired},
    Rule{"type", oneOf<kElementTypes>, kRequired},
    Rule{"normalized", flag},
    Rule{"min", listOf<number>},
    Rule{"max", listOf<number>},
    Rule{"sparse", objectOf<kSparse>},
    Rule{"name", text},
};

constexpr std::array kDraco{
    Rule{"bufferView", index, kRequired},
    Rule{"attributes", mapOf<index>, kRequired},
};
constexpr std::array kPrimitiveExtensions{Rule{"KHR_draco_mesh_compression", objectOf<kDraco>}};
constexpr std::array kPrimitive{
    Rule{"attributes", mapOf<index>, kRequired},
    Rule{"indices", index},
    Rule{"material", index},
    Rule{"mode", whole<0, 6>},
    Rule{"targets", listOf<mapOf<index>>},
    Rule{"extensions", extensionsOf<kPrimitiveExtensions>},
};
constexpr std::array kMesh{
    Rule{"primitives", listOf<objectOf<kPrimitive>>, kRequired},
    Rule{"weights", listOf<number>},
    Rule{"name", text},
};

constexpr std::array kNode{
    Rule{"mesh", index},          Rule{"camera", index},
    Rule{"skin", index},          Rule{"children", listOf<index>},
    Rule{"matrix", numbers<16>},  Rule{"translation", numbers<3>},
    Rule{"rotation", quaternion}, Rule{"scale", numbers<3>},
    Rule{"name", text},           Rule{"extensions", mapOf<object>},
};

constexpr std::array kScene{
    Rule{"nodes", listOf<index>},
    Rule{"name", text},
};

constexpr std::array kMetallicRoughness{
    Rule{"baseColorFactor", color},
    Rule{"metallicFactor", number},
    Rule{"roughnessFactor", number},
};
constexpr std::array kSpecularGlossiness{Rule{"diffuseFactor", color}};
constexpr std::array kMaterialExtensions{
    Rule{"KHR_materials_pbrSpecularGlossiness", objectOf<kSpecularGlossiness>}};
constexpr std::array kMaterialMembers{
    Rule{"pbrMetallicRoughness", objectOf<kMetallicRoughness>},
    Rule{"emissiveFactor", numbers<3>},
    Rule{"name", text},
    Rule{"extensions", extensionsOf<kMaterialExtensions>},
};

void material(json& value, const Place& place)
{
    objectOf<kMaterialMembers>(value, place);
    texturesWithin(value, place);
}

constexpr std::array kSource{Rule{"source", index}};
constexpr std::array kTexture{
    Rule{"source", index},
    Rule{"sampler", index},
    Rule{"name", text},
    Rule{"extensions", mapOf<objectOf<kSource>>},
};

constexpr std::array kImage{
    Rule{"uri", text},
    Rule{"bufferView", index},
    Rule{"mimeType", text},
    Rule{"name", text},
};

constexpr std::array kSampler{
    Rule{"wrapS", oneOf<kWraps>},
    Rule{"wrapT", oneOf<kWraps>},
    Rule{"magFilter", index},
    Rule{"minFilter", index},
};

constexpr std::array kPerspective{
    Rule{"yfov", number, kRequired},
    Rule{"znear", number, kRequired},
    Rule{"zfar", number},
    Rule{"aspectRatio", number},
};
constexpr std::array kOrthographic{
    Rule{"xmag", number, kRequired},
    Rule{"ymag", number, kRequired},
    Rule{"znear", number, kRequired},
    Rule{"zfar", number, kRequired},
};
constexpr std::array kCamera{
    Rule{"type", text, kRequired},
    Rule{"perspective", objectOf<kPerspective>},
    Rule{"orthographic", objectOf<kOrthographic>},
    Rule{"name", text},
};

// ---- the document

struct List
{
    const char* key;
    const char* item; // as messages call one
    Check check;
};

constexpr std::array kLists{
    List{"buffers", "buffer", objectOf<kBuffer>},
    List{"bufferViews", "bufferView", objectOf<kView>},
    List{"accessors", "accessor", objectOf<kAccessor>},
    List{"meshes", "mesh", objectOf<kMesh>},
    List{"nodes", "node", objectOf<kNode>},
    List{"scenes", "scene", objectOf<kScene>},
    List{"materials", "material", material},
    List{"textures", "texture", objectOf<kTexture>},
    List{"images", "image", objectOf<kImage>},
    List{"samplers", "sampler", objectOf<kSampler>},
    List{"cameras", "camera", objectOf<kCamera>},
};

constexpr std::array kLights{Rule{"lights", listOf<object>}};
constexpr std::array kDocumentExtensions{Rule{"KHR_lights_punctual", objectOf<kLights>}};
constexpr std::array kDocument{
    Rule{"scene", index},
    Rule{"extensionsUsed", listOf<text>},
    Rule{"extensionsRequired", listOf<text>},
    Rule{"extensions", extensionsOf<kDocumentExtensions>},
    Rule{"animations", listOf<object>},
    Rule{"skins", listOf<object>},
};

} // namespace

void checkShape(json& document, const std::string& file)
{
    objectOf<kDocument>(document, {file, nullptr, 0, ""});
    for (const List& list : kLists) {
        const auto found = document.find(list.key);
        if (found == document.end()) continue;
        if (!found->is_array()) Place{file, nullptr, 0, list.key}.fail("a list");
        for (size_t i = 0; i < found->size(); ++i)
            list.check((*found)[i], {file, list.item, i, list.key, true});
    }
}

} // namespace relamp
