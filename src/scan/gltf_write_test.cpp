#include "scan/gltf_write.h"

#include "relamp/error.h"
#include "relamp/version.h"
#include "scan/gltf_json.h"
#include "scenes/gltf_files.h"
#include "scenes/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using scenes::Bytes;
using scenes::bytesOf;
using scenes::GltfFile;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr float kGrey = 0.5f; // albedo of vertices, linear
constexpr uint8_t kGreyByte = 90;

Bytes greyPicture()
{
    return scenes::pictureFile(
        "png", scenes::Pixels<uint8_t>{2, 2, 3, std::vector<uint8_t>(12, kGreyByte)});
}

/// A grey room without emission, whatever the scan shows.
std::vector<RelitPage> greyPages(const Scan& scan)
{
    std::vector<RelitPage> pages(scan.pages.size());
    for (size_t p = 0; p < pages.size(); ++p)
        if (scan.pages[p].ofVertices)
            pages[p].vertexAlbedo.assign(3 * scan.pages[p].image.pixels(), kGrey);
        else
            pages[p].albedo = {greyPicture(), "image/png"};
    return pages;
}

/// A written file: read again as a scan, and as it lies there.
struct Written
{
    std::string glb;
    Scan scan;
    json document;
    std::string binary;
};

Written writeAgain(const Scan& scan, const std::vector<RelitPage>& pages, const Lights& lights = {})
{
    Written written{writeGlb(scan, pages, lights), {}, {}, {}};
    const GltfChunks chunks = splitGltf(scenes::asBytes(written.glb), "written");
    written.document = json::parse(chunks.json);
    written.binary.assign(reinterpret_cast<const char*>(chunks.binary.data()),
                          chunks.binary.size());
    written.scan = scenes::read(written.glb);
    return written;
}

Written rewrite(const GltfFile& file, const Lights& lights = {}, const ScanOptions& options = {})
{
    const Scan scan = scenes::read(file.glb(), options);
    return writeAgain(scan, greyPages(scan), lights);
}

const json& materialOf(const Written& written, size_t mesh = 0)
{
    const json& primitive = written.document["meshes"][mesh]["primitives"][0];
    return written.document["materials"].at(primitive["material"].get<size_t>());
}

std::vector<float> floatsOf(const Written& written, const json& accessor)
{
    const json& view = written.document["bufferViews"][accessor["bufferView"].get<size_t>()];
    std::vector<float> floats(accessor["count"].get<size_t>() * 3);
    std::memcpy(floats.data(),
                written.binary.data() + view["byteOffset"].get<size_t>() +
                    accessor.value("byteOffset", 0),
                floats.size() * sizeof(float));
    return floats;
}

} // namespace

TEST(GltfWrite, ReadAgainItIsTheSameSurfaceInItsAlbedo)
{
    for (const GltfFile& file :
         {scenes::texturedSquare(), scenes::meshoptSquare(), scenes::dracoSquare()}) {
        const Scan before = scenes::read(file.glb());
        const Scan after = rewrite(file).scan;
        ASSERT_THAT(after.meshes, SizeIs(1));
        EXPECT_EQ(after.meshes[0].positions, before.meshes[0].positions);
        EXPECT_EQ(after.meshes[0].uvs, before.meshes[0].uvs);
        EXPECT_EQ(after.meshes[0].triangles, before.meshes[0].triangles);
        EXPECT_THAT(after.pages.at(0).image.encoded(), Each(kGreyByte));
    }
}

TEST(GltfWrite, NodesNamesAndExtrasSurvive)
{
    GltfFile file = scenes::texturedSquare();
    file.addNode({{"name", "camera"}, {"camera", 0}, {"extras", {{"height", 1.5}}}});
    file.document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.125}}}}};
    file.document["nodes"][0]["translation"] = {1, 2, 3};
    file.document["meshes"][0]["extras"] = {{"room", "kitchen"}};
    file.material()["extras"] = {{"id", 7}};
    file.document["scenes"][0]["name"] = "flat";
    file.document["asset"]["copyright"] = "somebody";
    const Written written = rewrite(file);
    for (const char* key : {"nodes", "cameras", "scenes"})
        EXPECT_EQ(written.document[key], file.document[key]) << key;
    EXPECT_EQ(written.document["meshes"][0]["extras"]["room"], "kitchen");
    EXPECT_EQ(written.document["meshes"][0]["name"], "square");
    EXPECT_EQ(written.document["materials"][0]["extras"]["id"], 7);
    EXPECT_EQ(written.document["materials"][0]["name"], "paint");
    EXPECT_EQ(written.document["asset"]["copyright"], "somebody");
}

// A person who finds the file later has to see that it is no scan.
TEST(GltfWrite, SaysWhoWroteItAndKeepsWhoScanned)
{
    GltfFile file = scenes::texturedSquare();
    file.document["asset"]["generator"] = "scanner 7";
    file.document["asset"]["extras"] = {{"room", "kitchen"}};
    Lights lights;
    lights.ambient = glm::vec3(0.5f);
    const Written written = rewrite(file, lights);
    const json& asset = written.document["asset"];
    EXPECT_EQ(asset["generator"], std::string("relamp ") + version());
    EXPECT_EQ(asset["extras"]["room"], "kitchen");
    EXPECT_EQ(asset["extras"]["relamp"]["scanGenerator"], "scanner 7");
    EXPECT_EQ(asset["extras"]["relamp"]["textures"], "albedo");
    EXPECT_EQ(asset["extras"]["relamp"]["lights"]["ambient"], json({0.5, 0.5, 0.5}));
    const Written again = writeAgain(written.scan, greyPages(written.scan));
    EXPECT_EQ(again.document["asset"]["extras"]["relamp"]["scanGenerator"], "scanner 7");
}

TEST(GltfWrite, LightsHaveTheNamesOfTheirFixtures)
{
    Lights lights;
    lights.fixtures = {{.id = 4, .name = "ceiling lamp 4"}, {.id = 2, .name = "window 2"}};
    for (const int fixture : {1, 0, 1})
        lights.points.push_back({.intensity = glm::vec3(1.0f), .fixture = fixture});
    const Written written = rewrite(scenes::texturedSquare(), lights);
    const json& names = written.document["extensions"]["KHR_lights_punctual"]["lights"];
    EXPECT_EQ(names[0]["name"], "window 2, part 1");
    EXPECT_EQ(names[1]["name"], "ceiling lamp 4");
    EXPECT_EQ(names[2]["name"], "window 2, part 2");
}

TEST(GltfWrite, WhatWasLeftOutOfTheScanStaysAsItCame)
{
    GltfFile file = scenes::texturedSquare();
    json points = file.primitive();
    points["mode"] = 0;
    file.document["meshes"][0]["primitives"].push_back(points);
    json ceiling = file.document["meshes"][0];
    ceiling["name"] = "ceiling";
    ceiling["primitives"][0]["material"] = file.addMaterial();
    file.document["meshes"].push_back(ceiling);
    file.addNode({{"mesh", 1}});
    file.material(1)["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 0.5, 0.75, 1};
    file.material(1)["extensions"]["KHR_materials_unlit"] = json::object();
    file.document["extensionsUsed"] = {"KHR_materials_unlit"};

    const Written written = rewrite(file, {}, {.skipMeshes = {"ceiling"}});
    EXPECT_THAT(written.document["meshes"][0]["primitives"], SizeIs(2));
    EXPECT_THAT(written.document["nodes"], SizeIs(2));
    EXPECT_EQ(materialOf(written, 1)["pbrMetallicRoughness"]["baseColorFactor"],
              json({0.25, 0.5, 0.75, 1.0}));
    EXPECT_TRUE(materialOf(written, 1)["extensions"].contains("KHR_materials_unlit"));
    EXPECT_THAT(written.document["extensionsUsed"], ElementsAre("KHR_materials_unlit"));
}

// One material on all: the ceiling that was left out keeps its photo and its factor.
TEST(GltfWrite, WhatWasLeftOutKeepsWhatItSharedWithTheScan)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 0.5, 0.75, 1};
    json ceiling = file.document["meshes"][0];
    ceiling["name"] = "ceiling";
    file.document["meshes"].push_back(ceiling);
    file.addNode({{"mesh", 1}});
    const Scan before = scenes::read(file.glb(), {.skipMeshes = {"square"}});
    const Written written = rewrite(file, {}, {.skipMeshes = {"ceiling"}});
    ASSERT_THAT(written.scan.meshes, SizeIs(2));
    const auto pageOf = [&](size_t mesh) {
        return written.scan.pages.at(static_cast<size_t>(written.scan.meshes[mesh].page));
    };
    EXPECT_THAT(pageOf(0).image.encoded(), Each(kGreyByte));
    EXPECT_EQ(written.scan.meshes[0].factor, glm::vec3(1.0f));
    EXPECT_EQ(pageOf(1).image.encoded(), before.pages[0].image.encoded());
    EXPECT_EQ(written.scan.meshes[1].factor, glm::vec3(0.25f, 0.5f, 0.75f));
}

TEST(GltfWrite, SurfacesAreLitMatteAndOfNoOtherColourThanTheirAlbedo)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 0.25};
    file.material()["extensions"]["KHR_materials_unlit"] = json::object();
    file.document["extensionsUsed"] = {"KHR_materials_unlit"};
    const Written written = rewrite(file);
    const json& pbr = materialOf(written)["pbrMetallicRoughness"];
    EXPECT_EQ(pbr["baseColorFactor"],
              json({1.0, 1.0, 1.0, 0.25})); // how clear it is has not to do with light
    EXPECT_EQ(pbr["metallicFactor"], 0.0);
    EXPECT_FALSE(materialOf(written).contains("extensions"));
    EXPECT_FALSE(written.document.contains("extensionsUsed"));
}

TEST(GltfWrite, SpecularGlossinessBecomesMetallicRoughness)
{
    GltfFile file = scenes::texturedSquare();
    const json texture = file.material()["pbrMetallicRoughness"]["baseColorTexture"];
    file.material().erase("pbrMetallicRoughness");
    file.material()["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseTexture", texture}};
    file.document["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    const Written written = rewrite(file);
    EXPECT_EQ(materialOf(written)["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    EXPECT_FALSE(written.document.contains("extensionsUsed"));
}

// The default material of glTF is a mirror-like metal.
TEST(GltfWrite, APrimitiveWithoutMaterialGetsAMatteOne)
{
    const Written written = rewrite(scenes::coloredSquare());
    EXPECT_EQ(materialOf(written)["pbrMetallicRoughness"]["metallicFactor"], 0.0);
}

TEST(GltfWrite, LightsStandWhereTheyShineInTheUnitsOfTheFile)
{
    PointLight lamp;
    lamp.position = {1, 2, 3};
    lamp.intensity = {4, 2, 1};
    PointLight dark;
    const Written written = rewrite(scenes::texturedSquare(), {.points = {dark, lamp}},
                                    {.up = UpAxis::z, .scale = 0.5});
    const json& lights = written.document["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_THAT(lights, SizeIs(2)); // for viewers, and for Blender
    EXPECT_EQ(lights[0]["type"], "point");
    EXPECT_EQ(lights[0]["color"], json({1.0, 0.5, 0.25}));
    EXPECT_EQ(lights[0]["intensity"], 16.0); // E = I / d^2 stays when a metre is two units
    const json& node = written.document["nodes"][1];
    EXPECT_EQ(node["translation"],
              json({2.0, -6.0, 4.0})); // world (x, y, z) is (x, -z, y) of the file, twice
    EXPECT_EQ(node["extensions"]["KHR_lights_punctual"]["light"], 0);
    EXPECT_THAT(written.document["scenes"][0]["nodes"], ElementsAre(0, 1));
    EXPECT_THAT(written.document["extensionsUsed"], ElementsAre("KHR_lights_punctual"));
}

// three.js shows 1 cd/m^2 as white, Blender 683: each finds lights for which that is the scan's.
TEST(GltfWrite, EveryProgramHasASceneInWhichWhiteIsWhatItTakesForWhite)
{
    Lights lights;
    lights.points = {{.intensity = glm::vec3(2.0f)}};
    lights.sun = Sun{.irradiance = glm::vec3(3.0f)};
    const Written written = rewrite(scenes::texturedSquare(), lights);
    const json& scenes = written.document["scenes"];
    EXPECT_EQ(written.document["scene"], 0);
    EXPECT_THAT(scenes[0]["nodes"], ElementsAre(0, 1, 2));
    EXPECT_THAT(scenes[1]["nodes"], ElementsAre(0, 3, 4)); // the same room
    std::vector<double> intensities;
    for (const json& light : written.document["extensions"]["KHR_lights_punctual"]["lights"])
        intensities.push_back(light["intensity"]);
    EXPECT_THAT(intensities, ElementsAre(2.0, 3.0, 2.0 * 683.0, 3.0 * 683.0));
    EXPECT_EQ(scenes[0]["extras"]["relamp"]["whiteNits"], 1.0);
    EXPECT_EQ(scenes[1]["extras"]["relamp"]["whiteNits"], 683.0);
}

// A pane of area A and radiance L is a point of L A / 4 in relamp, and shows L A to one in front of
// it. Through the spot's falloff, 3 cos^2 - 2 cos^3, it sends pi L A, as the pane does.
TEST(GltfWrite, WhatFacesOneWayIsASpotThatSendsAllItsLightThere)
{
    PointLight pane;
    pane.normal = {0, 1, 0};
    pane.intensity = glm::vec3(0.5f);
    const Written written = rewrite(scenes::texturedSquare(), {.points = {pane}});
    const json& light = written.document["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_EQ(light["type"], "spot");
    EXPECT_EQ(light["intensity"], 2.0);
    EXPECT_EQ(light["spot"]["innerConeAngle"], 0.0);
    EXPECT_LE(light["spot"]["outerConeAngle"].get<double>(), std::acos(0.0)); // glTF takes no more
    const json& turn = written.document["nodes"][1]["rotation"];
    const glm::quat rotation(turn[3].get<float>(), turn[0].get<float>(), turn[1].get<float>(),
                             turn[2].get<float>());
    EXPECT_LT(glm::distance(rotation * glm::vec3(0, 0, -1), pane.normal), 1e-5f);
    double flux = 0.0;
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
        const double c = (i + 0.5) / kSteps;
        flux += 2.0 * glm::pi<double>() * 2.0 * (3.0 * c * c - 2.0 * c * c * c) / kSteps;
    }
    EXPECT_NEAR(flux, 4.0 * glm::pi<double>() * 0.5, 1e-4);
}

TEST(GltfWrite, SunShinesAlongItsNodesBackInTheAxesOfTheFile)
{
    Lights lights;
    lights.sun = Sun{.direction = {0.0f, 0.6f, 0.8f}, .irradiance = {8, 6, 2}};
    const Written written =
        rewrite(scenes::texturedSquare(), lights, {.up = UpAxis::z, .scale = 0.5});
    const json& sun = written.document["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_EQ(sun["type"], "directional");
    EXPECT_EQ(sun["intensity"], 8.0); // irradiance, whatever the unit of length
    EXPECT_EQ(sun["color"], json({1.0, 0.75, 0.25}));
    const json& turn = written.document["nodes"][1]["rotation"];
    const glm::quat rotation(turn[3].get<float>(), turn[0].get<float>(), turn[1].get<float>(),
                             turn[2].get<float>());
    const glm::vec3 towards = rotation * glm::vec3(0, 0, 1);
    EXPECT_LT(glm::distance(towards, glm::vec3(0.0f, -0.8f, 0.6f)), 1e-5f);
}

TEST(GltfWrite, AFileWithoutScenesShowsItsRoomBesideTheLights)
{
    GltfFile file = scenes::texturedSquare();
    file.document.erase("scenes");
    file.document.erase("scene");
    PointLight lamp;
    lamp.intensity = glm::vec3(1.0f);
    const Written written = rewrite(file, {.points = {lamp}});
    EXPECT_THAT(written.document["scenes"][0]["nodes"], ElementsAre(0, 1));
    EXPECT_THAT(written.scan.meshes, SizeIs(1));
}

TEST(GltfWrite, WhatShinesHasAnEmissiveTextureUnderTheSameTransform)
{
    GltfFile file = scenes::texturedSquare();
    json& texture = file.material()["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"]["scale"] = {0.5, 0.5};
    const Scan scan = scenes::read(file.glb());
    std::vector<RelitPage> pages = greyPages(scan);
    pages[0].emission = {scenes::pictureFile("png", scenes::fourColors()), "image/png"};
    const Written written = writeAgain(scan, pages);
    const json& material = materialOf(written);
    EXPECT_EQ(material["emissiveFactor"], json({1.0, 1.0, 1.0}));
    EXPECT_EQ(material["emissiveTexture"]["extensions"], texture["extensions"]);
    const size_t image =
        written.document["textures"][material["emissiveTexture"]["index"].get<size_t>()]["source"];
    EXPECT_EQ(image, 1u);
    EXPECT_EQ(written.scan.pages[0].image.encoded()[0],
              kGreyByte); // and the albedo is another picture
}

// Some programs show a photo without light by letting it glow. Left there, it would put the light
// back.
TEST(GltfWrite, APhotoThatGlowsDoesSoNoMore)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["emissiveTexture"]["index"] = 0;
    file.material()["emissiveFactor"] = {1, 1, 1};
    const Written written = rewrite(file);
    EXPECT_FALSE(materialOf(written).contains("emissiveTexture"));
    EXPECT_FALSE(materialOf(written).contains("emissiveFactor"));
}

TEST(GltfWrite, VertexColoursBecomeTheAlbedo)
{
    const Written written = rewrite(scenes::coloredSquare());
    const json& primitive = written.document["meshes"][0]["primitives"][0];
    const json& accessor =
        written.document["accessors"][primitive["attributes"]["COLOR_0"].get<size_t>()];
    EXPECT_THAT(floatsOf(written, accessor), Each(kGrey));
    EXPECT_EQ(accessor["count"], 4);
}

TEST(GltfWrite, VertexColoursOnATextureAreInTheAlbedoAndGo)
{
    GltfFile file = scenes::texturedSquare();
    file.primitive()["attributes"]["COLOR_0"] =
        file.addAccessor(bytesOf(std::vector<glm::vec3>(4, glm::vec3(0.5f))), 4, {});
    EXPECT_THAT(rewrite(file).scan.meshes[0].colors, IsEmpty());
}

// One mesh at two nodes is lit twice, and so has two albedos.
TEST(GltfWrite, InstancesOfAColouredMeshArePaintedEachByItself)
{
    GltfFile file = scenes::coloredSquare();
    file.addNode({{"mesh", 0}, {"translation", {0, 0, 3}}});
    const Scan scan = scenes::read(file.glb());
    std::vector<RelitPage> pages = greyPages(scan);
    std::fill(pages[0].vertexAlbedo.begin() + 12, pages[0].vertexAlbedo.end(), 0.25f);
    const Written written = writeAgain(scan, pages);
    EXPECT_EQ(written.document["nodes"][0]["mesh"], 0);
    EXPECT_EQ(written.document["nodes"][1]["mesh"], 1);
    ASSERT_THAT(written.scan.meshes, SizeIs(2));
    const Radiance radiance(written.scan.pages[0].image);
    EXPECT_EQ(radiance[written.scan.meshes[0].firstPixel].r, 0.5f);
    EXPECT_EQ(radiance[written.scan.meshes[1].firstPixel].r, 0.25f);
}

// A textured part beside the coloured one goes along with it to each node.
TEST(GltfWrite, InstancesOfAMeshThatIsColouredInPartAreRelitAsAWhole)
{
    GltfFile file = scenes::texturedSquare();
    json colored = file.primitive();
    colored.erase("material");
    colored["attributes"]["COLOR_0"] =
        file.addAccessor(bytesOf(std::vector<glm::vec3>(4, glm::vec3(0.5f))), 4, {});
    file.primitive()["attributes"]["COLOR_0"] = colored["attributes"]["COLOR_0"];
    file.document["meshes"][0]["primitives"].push_back(colored);
    file.addNode({{"mesh", 0}, {"translation", {0, 0, 3}}});
    const Written written = rewrite(file);
    ASSERT_THAT(written.scan.meshes, SizeIs(4));
    ASSERT_THAT(written.document["meshes"], SizeIs(2));
    for (const json& mesh : written.document["meshes"]) {
        EXPECT_FALSE(mesh["primitives"][0]["attributes"].contains("COLOR_0"));
        EXPECT_TRUE(mesh["primitives"][1].contains("material"));
    }
}

TEST(GltfWrite, OldPicturesAreGoneFromTheFile)
{
    GltfFile file = scenes::texturedSquare();
    const Bytes photo = scenes::pictureFile("png", scenes::fourColors());
    const Bytes webp = scenes::pictureFile("webp", scenes::fourColors());
    file.document["textures"][0]["extensions"]["EXT_texture_webp"]["source"] =
        file.addImage(webp, "image/webp");
    file.document["extensionsUsed"] = {"EXT_texture_webp"};
    const Written written = rewrite(file);
    EXPECT_EQ(written.glb.find(std::string(webp.begin(), webp.end())), std::string::npos);
    EXPECT_EQ(written.document["textures"][0]["source"], 1); // the one that relamp has read
    EXPECT_FALSE(written.document["textures"][0].contains("extensions"));
    EXPECT_FALSE(written.document.contains("extensionsUsed"));
    EXPECT_EQ(written.document["images"][1]["mimeType"], "image/png");
    EXPECT_EQ(rewrite(scenes::texturedSquare()).glb.find(std::string(photo.begin(), photo.end())),
              std::string::npos);
}

TEST(GltfWrite, ImagesThatShareTheirBytesAreReplacedEachByItself)
{
    GltfFile file = scenes::texturedSquare();
    file.document["images"].push_back(file.document["images"][0]);
    json second = file.primitive();
    second["material"] = file.addMaterial(1);
    file.document["meshes"][0]["primitives"].push_back(second);
    const Scan scan = scenes::read(file.glb());
    std::vector<RelitPage> pages = greyPages(scan);
    pages[1].albedo.bytes = scenes::pictureFile("png", scenes::Pixels<uint8_t>{1, 1, 3, {7, 7, 7}});
    const Written written = writeAgain(scan, pages);
    EXPECT_THAT(written.scan.pages.at(0).image.encoded(), Each(kGreyByte));
    EXPECT_THAT(written.scan.pages.at(1).image.encoded(), ElementsAre(7, 7, 7));
}

TEST(GltfWrite, NoNumberIsNanOrInfinite)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    GltfFile file = scenes::coloredSquare();
    const std::vector<glm::vec3> positions{
        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {kNan, -kInfinity, 1}}; // the last is nobody's
    const std::vector<glm::vec3> normals{{0, 0, 2}, {0, 0, 1}, {0, 0, 0}, {0, 3, 4}, {kNan, 0, 0}};
    const std::vector<glm::vec3> colors(5, glm::vec3(1.0f));
    file.primitive()["attributes"]["POSITION"] = file.addAccessor(bytesOf(positions), 5, {});
    file.primitive()["attributes"]["NORMAL"] = file.addAccessor(bytesOf(normals), 5, {});
    file.primitive()["attributes"]["COLOR_0"] = file.addAccessor(bytesOf(colors), 5, {});
    const Written written = rewrite(file);
    const json& attributes = written.document["meshes"][0]["primitives"][0]["attributes"];
    const json& accessors = written.document["accessors"];
    EXPECT_THAT(floatsOf(written, accessors[attributes["POSITION"].get<size_t>()]),
                Each(testing::Le(1.0f)));
    EXPECT_THAT(floatsOf(written, accessors[attributes["NORMAL"].get<size_t>()]),
                ElementsAre(0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0.6f, 0.8f, 0, 1, 0));
    EXPECT_EQ(accessors[attributes["POSITION"].get<size_t>()]["max"], json({1.0, 1.0, 1.0}));
}

TEST(GltfWrite, BoundsOfPositionsAreStatedAndTrue)
{
    GltfFile file = scenes::texturedSquare();
    file.accessorOf("POSITION")["max"] = {9, 9, 9};
    EXPECT_EQ(rewrite(file).document["accessors"][1]["max"], json({1.0, 1.0, 0.0}));
    file.accessorOf("POSITION").erase("min");
    file.accessorOf("POSITION").erase("max");
    EXPECT_EQ(rewrite(file).document["accessors"][1]["min"], json({0.0, 0.0, 0.0}));
}

TEST(GltfWrite, AScanOfAnotherFormatIsANodeAMesh)
{
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n";
    const Scan scan = scenes::read(ply, {}, "r\xe4um.ply"); // Latin-1, which JSON must not hold
    const Written written = writeAgain(scan, greyPages(scan));
    ASSERT_THAT(written.scan.meshes, SizeIs(1));
    EXPECT_EQ(written.scan.meshes[0].positions, scan.meshes[0].positions);
    EXPECT_EQ(written.document["nodes"][0]["name"], "r\xef\xbf\xbdum");
    EXPECT_EQ(Radiance(written.scan.pages[0].image)[2], glm::vec3(kGrey));
}

} // namespace relamp
