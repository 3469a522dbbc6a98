#include "scan/gltf_read.h"

#include "scan/gltf_json.h"

#include "scenes/gltf_files.h"
#include "scenes/pictures.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using scenes::bytesOf;
using scenes::GltfFile;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;

MATCHER_P2(Near, expected, tolerance, "")
{
    return glm::length(arg - expected) <= tolerance;
}

template<class Vector>
void expectNear(const std::vector<Vector>& found, const std::vector<Vector>& expected,
                float tolerance = 1e-6f)
{
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i)
        EXPECT_THAT(found[i], Near(expected[i], tolerance)) << "at " << i;
}

glm::vec3 facingOf(const Mesh& mesh, size_t triangle)
{
    const glm::uvec3& t = mesh.triangles.at(triangle);
    const glm::vec3 a = mesh.positions[t.x];
    return glm::normalize(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
}

/// The corners in the order of the triangles, whatever the vertices are numbered.
std::vector<glm::vec3> cornersOf(const Mesh& mesh)
{
    std::vector<glm::vec3> corners;
    for (const glm::uvec3& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) corners.push_back(mesh.positions[t[c]]);
    return corners;
}

std::vector<glm::vec3> squareCorners()
{
    std::vector<glm::vec3> corners;
    for (const uint16_t i : scenes::squareIndices())
        corners.push_back(scenes::squarePositions()[i]);
    return corners;
}

glm::vec3 pixel(const Page& page, size_t i)
{
    return Radiance(page.image)[i];
}

} // namespace

TEST(GltfRead, ASquareComesAsItWasWritten)
{
    const Scan scan = scenes::read(scenes::texturedSquare().glb());

    ASSERT_THAT(scan.meshes, SizeIs(1));
    const Mesh& mesh = scan.meshes[0];
    EXPECT_EQ(mesh.name, "square");
    EXPECT_EQ(mesh.positions, scenes::squarePositions());
    EXPECT_EQ(mesh.uvs, scenes::squareUvs());
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(2, 1, 3)));
    EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
    ASSERT_THAT(scan.pages, SizeIs(1));
    EXPECT_EQ(scan.pages[0].image.width, 2);
    EXPECT_EQ(pixel(scan.pages[0], 1), glm::vec3(0, 1, 0));
    EXPECT_EQ(pixel(scan.pages[0], 2), glm::vec3(0, 0, 1));
    EXPECT_EQ(scan.name, "room");
    EXPECT_THAT(scan.warnings, IsEmpty());
}

TEST(GltfRead, IndicesOfEveryWidthMeanTheSame)
{
    for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
        GltfFile file = scenes::texturedSquare();
        const auto wide = scenes::squareIndices();
        const auto bytes =
            type == kUnsignedByte    ? bytesOf(std::vector<uint8_t>(wide.begin(), wide.end()))
            : type == kUnsignedShort ? bytesOf(wide)
                                     : bytesOf(std::vector<uint32_t>(wide.begin(), wide.end()));
        file.primitive()["indices"] = file.addAccessor(bytes, 6, {type, "SCALAR"});
        expectNear(cornersOf(scenes::read(file.glb()).meshes[0]), squareCorners());
    }
}

TEST(GltfRead, WithoutIndicesEveryThreeVerticesAreATriangle)
{
    GltfFile file = scenes::texturedSquare();
    std::vector<glm::vec2> uvs;
    for (const uint16_t i : scenes::squareIndices()) uvs.push_back(scenes::squareUvs()[i]);
    file.primitive().erase("indices");
    file.primitive()["attributes"] = {
        {"POSITION", file.addAccessor(bytesOf(squareCorners()), 6, {})},
        {"TEXCOORD_0", file.addAccessor(bytesOf(uvs), 6, {.type = "VEC2"})}};
    const Scan scan = scenes::read(file.glb());
    expectNear(cornersOf(scan.meshes[0]), squareCorners());
    expectNear(scan.meshes[0].uvs, uvs);
}

// Strips turn every second triangle round; fans go around their first vertex. All must face z.
TEST(GltfRead, StripsAndFansFaceTheSideTheyWereWoundFor)
{
    for (const auto& [mode, order] :
         {std::pair{5, std::vector<uint16_t>{0, 1, 2, 3}}, {6, {0, 1, 3, 2}}}) {
        GltfFile file = scenes::texturedSquare();
        file.primitive()["mode"] = mode;
        file.primitive()["indices"] =
            file.addAccessor(bytesOf(order), 4, {kUnsignedShort, "SCALAR"});
        const Scan scan = scenes::read(file.glb());
        ASSERT_THAT(scan.meshes[0].triangles, SizeIs(2));
        EXPECT_EQ(facingOf(scan.meshes[0], 0), glm::vec3(0, 0, 1));
        EXPECT_EQ(facingOf(scan.meshes[0], 1), glm::vec3(0, 0, 1));
    }
}

TEST(GltfRead, PointsAndLinesAreLeftOutAndSaid)
{
    GltfFile file = scenes::texturedSquare();
    json points = file.primitive();
    points["mode"] = 0;
    file.document["meshes"][0]["primitives"].push_back(points);
    const Scan scan = scenes::read(file.glb());
    EXPECT_THAT(scan.meshes, SizeIs(1));
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("points and lines")));
}

TEST(GltfRead, InterleavedAttributesAreTakenApart)
{
    GltfFile file = scenes::texturedSquare();
    std::vector<float> interleaved;
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec3 p = scenes::squarePositions()[i];
        const glm::vec2 uv = scenes::squareUvs()[i];
        interleaved.insert(interleaved.end(), {p.x, p.y, p.z, uv.x, uv.y});
    }
    const size_t view = file.addView(bytesOf(interleaved), 20);
    file.primitive()["attributes"] = {
        {"POSITION", file.addAccessor(view, 4, {})},
        {"TEXCOORD_0", file.addAccessor(view, 4, {.type = "VEC2", .offset = 12})}};
    const Scan scan = scenes::read(file.glb());
    EXPECT_EQ(scan.meshes[0].positions, scenes::squarePositions());
    EXPECT_EQ(scan.meshes[0].uvs, scenes::squareUvs());
}

TEST(GltfRead, SparseValuesReplaceThoseBelow)
{
    GltfFile file = scenes::texturedSquare();
    const size_t at = file.addView(bytesOf(std::vector<uint8_t>{1, 3}));
    const size_t values = file.addView(bytesOf(std::vector<glm::vec3>{{2, 0, 0}, {2, 1, 0}}));
    file.accessorOf("POSITION")["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", at}, {"componentType", kUnsignedByte}}},
        {"values", {{"bufferView", values}}}};
    expectNear(scenes::read(file.glb()).meshes[0].positions,
               {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}});
}

TEST(GltfRead, SparseValuesWithoutABaseStandAmongZeros)
{
    GltfFile file = scenes::texturedSquare();
    const size_t at = file.addView(bytesOf(std::vector<uint16_t>{1, 2, 3}));
    const size_t values =
        file.addView(bytesOf(std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
    file.accessorOf("POSITION").erase("bufferView");
    file.accessorOf("POSITION")["sparse"] = {
        {"count", 3},
        {"indices", {{"bufferView", at}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", values}}}};
    EXPECT_EQ(scenes::read(file.glb()).meshes[0].positions, scenes::squarePositions());
}

// KHR_mesh_quantization: whole numbers, scaled into the room by the node; fractions are n / (2^b -
// 1).
TEST(GltfRead, QuantisedAttributesMeanWhatTheyStandFor)
{
    GltfFile file = scenes::texturedSquare();
    const std::vector<int16_t> positions{0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 100, 100, 0, 0};
    const std::vector<uint16_t> uvs{0, 0, 65535, 0, 0, 65535, 65535, 32768};
    const size_t view = file.addView(bytesOf(positions), 8);
    file.primitive()["attributes"] = {
        {"POSITION", file.addAccessor(view, 4, {kShort})},
        {"TEXCOORD_0", file.addAccessor(bytesOf(uvs), 4, {kUnsignedShort, "VEC2", true})}};
    file.document["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scan scan = scenes::read(file.glb());
    expectNear(scan.meshes[0].positions, scenes::squarePositions());
    expectNear(scan.meshes[0].uvs, {{0, 0}, {1, 0}, {0, 1}, {1, 32768.0f / 65535.0f}});
}

TEST(GltfRead, SignedFractionsReachMinusOneAndNoFurther)
{
    GltfFile file = scenes::texturedSquare();
    const std::vector<int8_t> normals{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, -128, 0, 127, 0};
    file.primitive()["attributes"]["NORMAL"] =
        file.addAccessor(file.addView(bytesOf(normals), 4), 4, {kByte, "VEC3", true});
    const Mesh mesh = scenes::read(file.glb()).meshes[0];
    EXPECT_THAT(mesh.normals[0], Near(glm::vec3(0, 0, 1), 1e-6f));
    EXPECT_THAT(mesh.normals[5],
                Near(glm::normalize(glm::vec3(-1, 0, 1)), 1e-6f)); // not -128 / 127
}

// The extension's own example: the lower left quarter of the picture, turned clockwise.
TEST(GltfRead, TextureTransformTurnsAsItsSpecificationShows)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                   ["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    expectNear(scenes::read(file.glb()).meshes[0].uvs,
               {{0, 1}, {0, 0.5f}, {0.5f, 1}, {0.5f, 0.5f}});
}

// Scale comes first, then rotation, then offset: (u, v) goes to (4v, -2u) + offset.
TEST(GltfRead, TextureTransformScalesRotatesAndMoves)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                   ["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 4}}};
    expectNear(scenes::read(file.glb()).meshes[0].uvs,
               {{0.5f, 0.25f}, {0.5f, -1.75f}, {4.5f, 0.25f}, {4.5f, -1.75f}});
}

TEST(GltfRead, TextureTransformMayNameAnotherSetOfCoordinates)
{
    GltfFile file = scenes::texturedSquare();
    const std::vector<glm::vec2> others{{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}, {0.7f, 0.8f}};
    file.primitive()["attributes"]["TEXCOORD_1"] =
        file.addAccessor(bytesOf(others), 4, {.type = "VEC2"});
    json& texture = file.material()["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(scenes::read(file.glb()).meshes[0].uvs, others);
}

TEST(GltfRead, NodesMoveWhatIsBelowThem)
{
    GltfFile file = scenes::texturedSquare();
    const float h = std::sqrt(0.5f);
    file.document["nodes"] = {
        {{"translation", {10, 0, 0}},
         {"rotation", {0, 0, h, h}},
         {"children", {1}}}, // a quarter turn about z
        {{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1}}, {"mesh", 0}}};
    // (x, y) -> twice as large and 5 up in z, then (-y, x) and 10 along x
    expectNear(scenes::read(file.glb()).meshes[0].positions,
               {{10, 0, 5}, {10, 2, 5}, {8, 0, 5}, {8, 2, 5}}, 1e-5f);
}

TEST(GltfRead, AMeshAtTwoNodesIsTwoMeshes)
{
    GltfFile file = scenes::texturedSquare();
    file.addNode({{"mesh", 0}, {"translation", {0, 0, 3}}});
    const Scan scan = scenes::read(file.glb());
    ASSERT_THAT(scan.meshes, SizeIs(2));
    EXPECT_EQ(scan.meshes[1].positions[0], glm::vec3(0, 0, 3));
    EXPECT_THAT(scan.pages, SizeIs(1));
}

TEST(GltfRead, UpZStandsTheRoomOnItsFloorAndScaleMakesMetres)
{
    ScanOptions options{.up = UpAxis::z, .scale = 0.01};
    const Scan scan = scenes::read(scenes::texturedSquare().glb(), options);
    expectNear(scan.meshes[0].positions,
               {{0, 0, 0}, {0.01f, 0, 0}, {0, 0, -0.01f}, {0.01f, 0, -0.01f}});
    EXPECT_THAT(scan.meshes[0].normals[0],
                Near(glm::vec3(0, 1, 0), 1e-6f)); // what faced z faces up
}

// A mirror turns left-handed what was right-handed: the triangle is wound the other way, the side
// that shows stays the same.
TEST(GltfRead, AMirroredMeshShowsTheSameSide)
{
    GltfFile file = scenes::texturedSquare();
    file.document["nodes"][0]["scale"] = {-1, 1, 1};
    const Mesh mesh = scenes::read(file.glb()).meshes[0];
    EXPECT_EQ(facingOf(mesh, 0), glm::vec3(0, 0, 1));
    EXPECT_THAT(mesh.normals[0], Near(glm::vec3(0, 0, 1), 1e-6f));
}

TEST(GltfRead, NormalsFollowTheInverseTransposeOfTheirNode)
{
    GltfFile file = scenes::texturedSquare();
    const glm::vec3 slanted = glm::normalize(glm::vec3(1, 0, 1));
    file.primitive()["attributes"]["NORMAL"] =
        file.addAccessor(bytesOf(std::vector<glm::vec3>(4, slanted)), 4, {});
    file.document["nodes"][0]["scale"] = {2, 1, 1}; // a slope of one becomes a slope of a half
    const Mesh mesh = scenes::read(file.glb()).meshes[0];
    EXPECT_THAT(mesh.normals[0], Near(glm::normalize(glm::vec3(0.5f, 0, 1)), 1e-6f));
}

TEST(GltfRead, MaterialsWithPicturesOfTheirOwnArePages)
{
    GltfFile file = scenes::texturedSquare();
    const size_t wide = file.addImage(
        scenes::pictureFile("png", scenes::Pixels<uint8_t>{4, 1, 3, std::vector<uint8_t>(12, 128)}),
        "image/png");
    json second = file.primitive();
    second["material"] = file.addMaterial(static_cast<int>(wide));
    json third = file.primitive();
    third["material"] = file.addMaterial(0); // a second material of the first picture
    file.document["meshes"][0]["primitives"].push_back(second);
    file.document["meshes"][0]["primitives"].push_back(third);

    const Scan scan = scenes::read(file.glb());
    ASSERT_THAT(scan.meshes, SizeIs(3));
    EXPECT_EQ(scan.meshes[0].page, 0);
    EXPECT_EQ(scan.meshes[1].page, 1);
    EXPECT_EQ(scan.meshes[2].page, 0);
    ASSERT_THAT(scan.pages, SizeIs(2));
    EXPECT_EQ(scan.pages[1].image.width, 4);
    EXPECT_EQ(scan.pages[1].image.height, 1);
    EXPECT_EQ(scan.gltf->imageOfPage, (std::vector<int>{0, 1}));
}

TEST(GltfRead, FactorAndVertexColoursMultiplyTheTexture)
{
    GltfFile file = scenes::texturedSquare();
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
    const std::vector<uint8_t> colors{255, 0, 51, 255, 255, 0, 51, 255,
                                      255, 0, 51, 255, 255, 0, 51, 255};
    file.primitive()["attributes"]["COLOR_0"] =
        file.addAccessor(bytesOf(colors), 4, {kUnsignedByte, "VEC4", true});
    const Mesh mesh = scenes::read(file.glb()).meshes[0];
    EXPECT_EQ(mesh.factor, glm::vec3(0.5f, 0.25f, 1.0f));
    expectNear(mesh.colors, std::vector<glm::vec3>(4, {1, 0, 0.2f}));
}

TEST(GltfRead, WrappingComesFromTheSampler)
{
    GltfFile file = scenes::texturedSquare();
    file.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    file.document["textures"][0]["sampler"] = 0;
    const Mesh mesh = scenes::read(file.glb()).meshes[0];
    EXPECT_EQ(mesh.wrapU, Wrap::clamp);
    EXPECT_EQ(mesh.wrapV, Wrap::mirror);
}

TEST(GltfRead, VertexColoursWithoutATextureAreAPageOfTheirOwn)
{
    GltfFile file = scenes::coloredSquare();
    file.primitive()["material"] = file.addMaterial();
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    const Scan scan = scenes::read(file.glb());
    ASSERT_THAT(scan.pages, SizeIs(1));
    const Page& page = scan.pages[0];
    EXPECT_TRUE(page.ofVertices);
    EXPECT_EQ(page.image.pixels(), 4u);
    EXPECT_EQ(pixel(page, 0), glm::vec3(0.5f, 0, 0));
    EXPECT_EQ(pixel(page, 3), glm::vec3(0.5f, 1, 1));
    EXPECT_EQ(scan.meshes[0].factor, glm::vec3(1.0f)); // it is in the page now
    EXPECT_EQ(scan.gltf->imageOfPage, (std::vector<int>{-1}));
}

TEST(GltfRead, SpecularGlossinessHasAColourToo)
{
    GltfFile file = scenes::texturedSquare();
    const json texture = file.material()["pbrMetallicRoughness"]["baseColorTexture"];
    file.material().erase("pbrMetallicRoughness");
    file.material()["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseTexture", texture}, {"diffuseFactor", {0.5, 1, 1, 1}}};
    const Scan scan = scenes::read(file.glb());
    EXPECT_EQ(scan.meshes[0].page, 0);
    EXPECT_FALSE(scan.pages[0].ofVertices);
    EXPECT_EQ(scan.meshes[0].factor, glm::vec3(0.5f, 1, 1));
}

TEST(GltfRead, DracoUnpacksToTheSameSquare)
{
    const Scan scan = scenes::read(scenes::dracoSquare().glb());
    ASSERT_THAT(scan.meshes, SizeIs(1));
    const Mesh& mesh = scan.meshes[0];
    ASSERT_THAT(mesh.triangles, SizeIs(2));
    for (const glm::vec3& p : mesh.positions)
        EXPECT_NEAR(p.x * (1 - p.x) + p.y * (1 - p.y), 0.0f, 1e-3f);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_THAT(glm::vec2(mesh.positions[i]),
                    Near(mesh.uvs[i], 1e-3f)); // one is the other here
    EXPECT_THAT(facingOf(mesh, 0), Near(glm::vec3(0, 0, 1), 1e-3f));
    EXPECT_THAT(facingOf(mesh, 1), Near(glm::vec3(0, 0, 1), 1e-3f));
}

TEST(GltfRead, MeshoptUnpacksToTheSameSquareExactly)
{
    const Scan scan = scenes::read(scenes::meshoptSquare().glb());
    EXPECT_EQ(scan.meshes[0].positions, scenes::squarePositions());
    EXPECT_EQ(scan.meshes[0].uvs, scenes::squareUvs());
    expectNear(cornersOf(scan.meshes[0]), squareCorners());
}

TEST(GltfRead, WebpIsPreferredWhereATextureHasBoth)
{
    GltfFile file = scenes::texturedSquare();
    const scenes::Pixels<uint8_t> grey{4, 4, 3, std::vector<uint8_t>(48, 128)};
    const size_t webp = file.addImage(scenes::pictureFile("webp", grey), "image/webp");
    file.document["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = webp;
    EXPECT_EQ(scenes::read(file.glb()).pages[0].image.width, 4);

    file.document["textures"][0].erase("source");
    file.document["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_EQ(scenes::read(file.glb()).pages[0].image.width, 4);
}

TEST(GltfRead, BasisUniversalIsRefusedUnlessThereIsAnotherPicture)
{
    GltfFile file = scenes::texturedSquare();
    file.document["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 0;
    EXPECT_EQ(scenes::refusal(file.glb()), "");

    file.document["textures"][0].erase("source");
    EXPECT_THAT(scenes::refusal(file.glb()),
                AllOf(HasSubstr("room.glb: mesh \"square\": its texture is in KTX2"),
                      HasSubstr("npx @gltf-transform/cli ktxdecompress")));
}

TEST(GltfRead, ExtensionsItCannotDoWithoutAreNamed)
{
    GltfFile file = scenes::texturedSquare();
    file.document["extensionsUsed"] = {"ACME_holes", "KHR_materials_unlit"};
    EXPECT_EQ(scenes::refusal(file.glb()), "");
    file.document["extensionsRequired"] = {"KHR_materials_unlit", "ACME_holes"};
    EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("requires the glTF extension ACME_holes"));
}

TEST(GltfRead, TrianglesWithoutAreaAreLeftOutAndCounted)
{
    GltfFile file = scenes::texturedSquare();
    const std::vector<uint16_t> indices{0, 1, 2, 0, 1, 1, 0, 0, 0, 2, 1, 3};
    file.primitive()["indices"] =
        file.addAccessor(bytesOf(indices), 12, {kUnsignedShort, "SCALAR"});
    const Scan scan = scenes::read(file.glb());
    EXPECT_THAT(scan.meshes[0].triangles, SizeIs(2));
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("2 triangles without area")));
}

TEST(GltfRead, NumbersThatMeanNothingAreRefusedInEveryAttribute)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec3> broken{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kNan, 1, 0}};
    for (const char* attribute : {"POSITION", "COLOR_0", "NORMAL"}) {
        GltfFile file = scenes::coloredSquare();
        file.primitive()["attributes"][attribute] = file.addAccessor(bytesOf(broken), 4, {});
        EXPECT_THAT(scenes::refusal(file.glb()),
                    HasSubstr("room.glb: mesh \"square\": 1 of its 4 vertices "))
            << attribute;
    }
    GltfFile file = scenes::texturedSquare();
    file.primitive()["attributes"]["TEXCOORD_0"] =
        file.addAccessor(bytesOf(std::vector<glm::vec2>{{0, 0}, {1e37f, 0}, {0, -1e37f}, {1, 1}}),
                         4, {.type = "VEC2"});
    EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("2 of its 4 vertices have texture"));
}

// Nothing along one axis, it has no inverse to turn normals by.
TEST(GltfRead, AFlattenedMeshTakesTheNormalsOfItsFaces)
{
    GltfFile file = scenes::texturedSquare();
    file.primitive()["attributes"]["NORMAL"] =
        file.addAccessor(bytesOf(std::vector<glm::vec3>(4, {0, 0, 1})), 4, {});
    file.document["nodes"][0]["scale"] = {1, 1, 0};
    EXPECT_THAT(scenes::read(file.glb()).meshes[0].normals, testing::Each(glm::vec3(0, 0, 1)));
}

TEST(GltfRead, AMeshThatIsSkippedMayBeAsBrokenAsItLikes)
{
    GltfFile file = scenes::texturedSquare();
    file.addMesh({{"POSITION", 999}});
    file.document["meshes"][1]["name"] = "ceiling";
    file.addNode({{"mesh", 1}});
    EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("mesh \"ceiling\": refers to accessor 999"));
    const Scan scan = scenes::read(file.glb(), {.skipMeshes = {"ceiling", "cieling"}});
    EXPECT_THAT(scan.meshes, SizeIs(1));
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("no mesh is called \"cieling\"")));
}

TEST(GltfRead, WithoutAScenesListAllRootsAreShown)
{
    GltfFile file = scenes::texturedSquare();
    file.document["nodes"] = {{{"children", {1}}, {"translation", {1, 0, 0}}}, {{"mesh", 0}}};
    file.document.erase("scenes");
    file.document.erase("scene");
    const Scan scan = scenes::read(file.glb());
    ASSERT_THAT(scan.meshes, SizeIs(1)); // not a second time as a root
    EXPECT_EQ(scan.meshes[0].positions[0], glm::vec3(1, 0, 0));
}

// A camera looks along its node's -z; a scale of the node says nothing, and an orthographic one is
// no view into a room.
TEST(GltfRead, CamerasComeWithTheirPlaceAndIndex)
{
    GltfFile file = scenes::coloredSquare();
    file.document["cameras"] = {
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}},
        {{"type", "perspective"},
         {"name", "door"},
         {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}}};
    file.addNode({{"camera", 0}});
    file.addNode({{"camera", 1},
                  {"translation", {1, 2, 3}},
                  {"rotation", {0, 0.70710678, 0, 0.70710678}}, // a quarter turn about y
                  {"scale", {2, 3, 4}}});
    const Scan scan = scenes::read(file.glb());
    ASSERT_THAT(scan.cameras, SizeIs(1));
    EXPECT_EQ(scan.cameras[0].index, 1);
    EXPECT_EQ(scan.cameras[0].name, "door");
    const Camera& camera = scan.cameras[0].camera;
    EXPECT_THAT(camera.position, Near(glm::vec3(1, 2, 3), 1e-5f));
    EXPECT_THAT(camera.forward, Near(glm::vec3(-1, 0, 0), 1e-5f));
    EXPECT_THAT(camera.up, Near(glm::vec3(0, 1, 0), 1e-5f));
    EXPECT_FLOAT_EQ(camera.fieldOfView, 0.9f);
    EXPECT_EQ(camera.across, Across::height);
}

} // namespace relamp
