#include "scan/gltf_shape.h"

#include "scan/gltf_write.h"
#include "scenes/gltf_files.h"
#include "scenes/pictures.h"
#include "scenes/refusal.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using scenes::GltfFile;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The textured square with something of all that relamp reads.
GltfFile squareWithEverything()
{
    GltfFile file = scenes::texturedSquare();
    json& document = file.document;
    json& material = file.material();
    json& texture = material["pbrMetallicRoughness"]["baseColorTexture"];
    texture["texCoord"] = 0;
    texture["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 0}}, {"rotation", 0.0}, {"scale", {1, 1}}, {"texCoord", 0}};
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
    material["emissiveTexture"] = {{"index", 0}};
    material["emissiveFactor"] = {1, 1, 1};
    material["extensions"]["KHR_materials_specular"]["specularTexture"] = {{"index", 0}};
    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseFactor", {1, 1, 1, 1}}, {"diffuseTexture", {{"index", 0}}}};
    material["extras"] = {{"someTexture", "not of glTF"}};
    document["materials"].push_back({{"name", "another"}, {"emissiveTexture", {{"index", 0}}}});
    json other = file.primitive();
    other["material"] = 1;
    other["mode"] = 1; // lines, which are left out
    document["meshes"][0]["primitives"].push_back(other);

    file.accessorOf("POSITION")["normalized"] = false;
    file.accessorOf("POSITION")["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", file.addView({0})}, {"byteOffset", 0}, {"componentType", 5121}}},
        {"values",
         {{"bufferView", file.addView(scenes::bytesOf(std::vector<float>{0, 0, 0}))},
          {"byteOffset", 0}}}};
    document["textures"][0]["sampler"] = 0;
    document["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 0;
    document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9729}}};
    document["images"][0]["name"] = "wall";
    document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    file.addNode({{"camera", 0}, {"rotation", {0, 0, 0, 1}}, {"translation", {0, 0, 1}}});
    file.addNode({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                  {"scale", {1, 1, 1}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    document["nodes"].push_back({{"name", "below"}});
    document["nodes"][1]["children"] = {3};
    document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    document["extensionsUsed"] = {"KHR_lights_punctual"};
    document["extensionsRequired"] = {"KHR_lights_punctual"};
    document["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    return file;
}

/// All places within, the document itself left out.
std::vector<json::json_pointer> placesIn(const json& document)
{
    std::vector<json::json_pointer> places;
    const json flat = document.flatten();
    for (const auto& [key, value] : flat.items())
        for (json::json_pointer place(key); !place.empty(); place = place.parent_pointer())
            if (std::find(places.begin(), places.end(), place) == places.end())
                places.push_back(place);
    return places;
}

/// Reads the file, and writes it with lights in it.
void readAndWrite(const std::string& glb)
{
    const Scan scan = scenes::read(glb);
    std::vector<RelitPage> pages(scan.pages.size());
    for (size_t p = 0; p < pages.size(); ++p)
        if (scan.pages[p].ofVertices)
            pages[p].vertexAlbedo.assign(3 * scan.pages[p].image.pixels(), 0.5f);
        else
            pages[p].albedo = {{1}, "image/png"};
    Lights lights;
    lights.points.push_back({.position = glm::vec3(0.0f), .intensity = glm::vec3(1.0f)});
    writeGlb(scan, pages, lights);
    writeUnlitGlb(scan, pages);
}

std::string refusalWith(const char* pointer, const json& value)
{
    GltfFile file = squareWithEverything();
    file.document[json::json_pointer(pointer)] = value;
    return scenes::refusal(file.glb());
}

} // namespace

TEST(GltfShape, WhatIsRightIsTaken)
{
    EXPECT_EQ(scenes::refusalOf([] { readAndWrite(squareWithEverything().glb()); }), "");
}

TEST(GltfShape, NumbersThatLeadNowhereAreNoNumbers)
{
    for (const char* pointer :
         {"/meshes/0/primitives/0/indices", "/meshes/0/primitives/0/material", "/nodes/0/mesh",
          "/nodes/1/camera", "/textures/0/source", "/textures/0/sampler", "/accessors/0/bufferView",
          "/meshes/0/primitives/0/attributes/POSITION", "/nodes/1/children/0", "/scenes/0/nodes/0",
          "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord"})
        for (const json& wrong : {json(-1), json("0"), json(0.5), json(4294967295), json()}) {
            const std::string sentence = refusalWith(pointer, wrong);
            EXPECT_THAT(sentence, HasSubstr("must be a whole number from 0")) << pointer << wrong;
            EXPECT_THAT(sentence, StartsWith("room.glb: ")) << pointer << wrong;
        }
}

TEST(GltfShape, ListsHaveTheirLength)
{
    const std::vector<std::pair<const char*, size_t>> lists{
        {"/nodes/2/matrix", 16},
        {"/nodes/1/translation", 3},
        {"/nodes/1/rotation", 4},
        {"/nodes/2/scale", 3},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", 4},
        {"/materials/0/emissiveFactor", 3},
        {"/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", 4}};
    for (const auto& [pointer, length] : lists)
        for (const json& wrong : {json({1, 0}), json(1), json(std::vector<std::string>(length))})
            EXPECT_THAT(refusalWith(pointer, wrong),
                        HasSubstr(fmt::format("must be a list of {} numbers", length)))
                << pointer << wrong;
}

TEST(GltfShape, ValuesThatMeanNothingAreNamedWithTheirPlace)
{
    EXPECT_THAT(
        refusalWith("/materials/0/pbrMetallicRoughness/baseColorFactor", {-1, 1, 1, 1}),
        HasSubstr("material 0: \"baseColorFactor\" must be 4 numbers from 0 to 65504; export it"));
    EXPECT_THAT(refusalWith("/nodes/1/rotation", {0, 0, 0, 0}),
                HasSubstr("node 1: \"rotation\" must be a turn"));
    EXPECT_THAT(refusalWith("/meshes/0/primitives/0/mode", 7),
                HasSubstr("mesh 0: \"mode\" must be a whole number from 0 to 6"));
    EXPECT_THAT(refusalWith("/samplers/0/wrapS", 1),
                HasSubstr("\"wrapS\" must be one of 10497, 33071, 33648"));
    EXPECT_THAT(refusalWith("/accessors/0/type", "VEC5"), HasSubstr("\"type\" must be one of"));
    EXPECT_THAT(refusalWith("/bufferViews/0/byteStride", 6), HasSubstr("multiple of 4"));
    EXPECT_THAT(refusalWith("/nodes/0", 5), HasSubstr("each of \"nodes\" must be an object"));
    EXPECT_THAT(refusalWith("/extensionsUsed", 5), HasSubstr("\"extensionsUsed\" must be a list"));
    EXPECT_THAT(refusalWith("/extensionsUsed", {5}),
                HasSubstr("each of \"extensionsUsed\" must be a text"));
    EXPECT_THAT(refusalWith("/accessors/0/count", json()), HasSubstr("accessor 0: \"count\" must"));
    EXPECT_THAT(refusalWith("/cameras/0", json::object()), HasSubstr("\"type\" must be there"));
}

TEST(GltfShape, WholeNumbersMayBeWrittenWithAPoint)
{
    EXPECT_EQ(refusalWith("/accessors/0/count", 4.0), "");
    EXPECT_EQ(refusalWith("/nodes/0/mesh", 0.0), "");
}

// Whatever stands wherever, it is a scan that can be written, or a sentence of our own.
TEST(GltfShape, NoWordsOfALibraryComeOutOfAnyDocument)
{
    const std::vector<json> wrong{json(),         true,         -1,         0.5,
                                  1e300,          "text",       {{1}},      json::array(),
                                  json::object(), {{"a", "b"}}, 4294967296, {-1, ""}};
    for (const GltfFile& good :
         {squareWithEverything(), scenes::dracoSquare(), scenes::meshoptSquare()}) {
        GltfFile whole = good;
        if (!whole.document.contains("buffers"))
            whole.document["buffers"] = {{{"byteLength", whole.binary.size()}}};
        for (const json::json_pointer& place : placesIn(whole.document))
            for (const json& value : wrong) {
                SCOPED_TRACE(place.to_string() + " = " + value.dump());
                GltfFile file = whole;
                file.document[place] = value;
                const std::string sentence = scenes::refusalOf([&] { readAndWrite(file.glb()); });
                EXPECT_THAT(sentence, AnyOf("", StartsWith("room.glb: ")));
                EXPECT_THAT(sentence, Not(ContainsRegex("exception|std::|error\\.|vector|_M_")));
            }
    }
}

} // namespace relamp
