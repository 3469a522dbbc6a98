// Scans that are whole, and wrong in what they say.

#include "malformed/run_in_folder.h"
#include "scenes/gltf_files.h"
#include "scenes/pictures.h"

#include <limits>

#include <gmock/gmock.h>

namespace relamp::malformed
{
namespace
{

using nlohmann::json;
using scenes::GltfFile;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int64_t kAbsurd = 4'000'000'000;

class WrongGlb : public RunInFolder
{
protected:
    void expectRefused(const GltfFile& file, const std::string& words) const
    {
        write("room.glb", file.glb());
        RunInFolder::expectRefused("room.glb", words);
    }
    /// The same of the reader alone, in this process, which is much faster.
    static void expectReaderRefuses(const GltfFile& file)
    {
        EXPECT_THAT(scenes::refusal(file.glb()), testing::StartsWith("room.glb: "));
    }
    void expectTaken(const GltfFile& file, const std::string& words) const
    {
        write("room.glb", file.glb());
        RunInFolder::expectTaken("room.glb", words);
    }
};

using WrongPly = RunInFolder;
using WrongObj = RunInFolder;
using WrongPicture = RunInFolder;

/// The textured square with other positions or texture coordinates.
template<class Vector>
GltfFile squareWith(const char* attribute, const std::vector<Vector>& values)
{
    GltfFile file = scenes::texturedSquare();
    json& accessor = file.accessorOf(attribute);
    accessor["bufferView"] = file.addView(scenes::bytesOf(values));
    accessor.erase("min");
    accessor.erase("max");
    return file;
}

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

} // namespace

TEST_F(WrongGlb, AbsurdCountsAreRefused)
{
    GltfFile vertices = scenes::texturedSquare();
    vertices.accessorOf("POSITION")["count"] = kAbsurd;
    expectRefused(vertices, "");

    for (const char* key : {"byteOffset", "bufferView"}) {
        GltfFile file = scenes::texturedSquare();
        file.accessorOf("POSITION")[key] = kAbsurd;
        expectReaderRefuses(file);
    }
    for (const char* key : {"byteLength", "byteOffset", "buffer"}) {
        GltfFile file = scenes::texturedSquare();
        file.document["bufferViews"][1][key] = kAbsurd;
        expectReaderRefuses(file);
    }
    GltfFile sparse = scenes::texturedSquare();
    sparse.accessorOf("POSITION")["sparse"] = {
        {"count", kAbsurd},
        {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
        {"values", {{"bufferView", 0}}}};
    expectReaderRefuses(sparse);
}

TEST_F(WrongGlb, VerticesThatAreNotThereAreRefused)
{
    GltfFile file = scenes::texturedSquare();
    json& indices = file.document["accessors"][file.primitive()["indices"].get<size_t>()];
    indices["bufferView"] =
        file.addView(scenes::bytesOf(std::vector<uint16_t>{0, 1, 2, 2, 1, 60000}));
    expectRefused(file, "refers to vertex 60000, and it has 4");
}

TEST_F(WrongGlb, PartsThatAreNotThereAreRefused)
{
    for (const char* pointer :
         {"/nodes/0/mesh", "/meshes/0/primitives/0/material", "/meshes/0/primitives/0/indices",
          "/meshes/0/primitives/0/attributes/POSITION", "/images/0/bufferView",
          "/textures/0/source", "/scenes/0/nodes/0", "/scene",
          "/materials/0/pbrMetallicRoughness/baseColorTexture/index"}) {
        SCOPED_TRACE(pointer);
        GltfFile file = scenes::texturedSquare();
        file.document[json::json_pointer(pointer)] = 1000;
        expectReaderRefuses(file);
    }
    GltfFile mesh = scenes::texturedSquare();
    mesh.document["nodes"][0]["mesh"] = 1000;
    expectRefused(mesh, "refers to mesh 1000, which is not there");
}

TEST_F(WrongGlb, NodesThatAreNoTreeAreRefused)
{
    GltfFile cycle = scenes::texturedSquare();
    cycle.document["nodes"][0]["children"] = {1};
    cycle.document["nodes"].push_back({{"children", {0}}});
    expectRefused(cycle, "is below itself or has two parents");

    GltfFile itself = scenes::texturedSquare();
    itself.document["nodes"][0]["children"] = {0};
    expectRefused(itself, "is below itself or has two parents");
}

TEST_F(WrongGlb, ALongChainOfNodesIsNoDanger)
{
    GltfFile chain = scenes::texturedSquare();
    constexpr int kLength = 20'000;
    for (int i = 1; i <= kLength; ++i) chain.document["nodes"].push_back({{"children", {i + 1}}});
    chain.document["nodes"][kLength].erase("children");
    chain.document["nodes"][0]["children"] = {1};
    expectTaken(chain, "");
}

TEST_F(WrongGlb, WithoutAnythingToSeeItIsRefused)
{
    expectRefused(GltfFile{}, "has no triangles");
    GltfFile empty = scenes::texturedSquare();
    empty.document["scenes"][0]["nodes"] = json::array();
    expectRefused(empty, "has no triangles");
    GltfFile points = scenes::texturedSquare();
    points.primitive()["mode"] = 0;
    expectRefused(points, "points and lines have no surface");
}

TEST_F(WrongGlb, ASurfaceWithoutAreaIsRefused)
{
    expectRefused(squareWith("POSITION", std::vector<glm::vec3>(4, {1, 2, 3})),
                  "2 triangles without area were left out");
}

TEST_F(WrongGlb, VerticesThatAreNoPlaceAreRefused)
{
    for (const float bad : {kNan, 3e38f}) {
        std::vector<glm::vec3> positions = scenes::squarePositions();
        positions[3].y = bad;
        expectRefused(squareWith("POSITION", positions), "1 of its 4 vertices lie at no place");
        positions[1].x = bad;
        expectRefused(squareWith("POSITION", positions), "2 of its 4 vertices lie at no place");
    }
}

TEST_F(WrongGlb, TextureCoordinatesThatTellNoPixelAreRefused)
{
    for (const float bad : {kNan, -kInfinity, 1e37f, 1e15f}) {
        std::vector<glm::vec2> uvs = scenes::squareUvs();
        uvs[3].y = bad;
        expectRefused(squareWith("TEXCOORD_0", uvs), "1 of its 4 vertices have texture");
    }
}

TEST_F(WrongGlb, ValuesOfAnotherTypeOrRangeAreRefused)
{
    const std::vector<std::pair<const char*, json>> cases{
        {"/meshes/0/primitives/0/indices", -1},
        {"/meshes/0/primitives/0/indices", "2"},
        {"/meshes/0/primitives/0/mode", 7},
        {"/nodes/0/matrix", {1, 2, 3}},
        {"/nodes/0/rotation", {0, 0, 1}},
        {"/nodes/0/scale", "large"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", {-1, 1, 1, 1}},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", "0"},
        {"/accessors/0/normalized", "yes"},
        {"/extensionsUsed", 5},
        {"/extensionsRequired", 5},
        {"/scenes", 5}};
    for (const auto& [pointer, value] : cases) {
        GltfFile file = scenes::texturedSquare();
        file.document[json::json_pointer(pointer)] = value;
        expectRefused(file, "must be");
    }
}

TEST_F(WrongGlb, FilesOutsideOfItsFolderAreNotCarriedOff)
{
    for (const char* uri :
         {"../../../../../../etc/passwd", "/etc/passwd", "%2e%2e/../etc/passwd"}) {
        GltfFile picture = scenes::texturedSquare();
        picture.document["images"][0] = {{"uri", uri}};
        expectRefused(picture, "--allow-outside");
        write("room.gltf", scenes::texturedSquare().gltf(uri));
        RunInFolder::expectRefused("room.gltf", "--allow-outside");
    }
}

TEST_F(WrongGlb, WithoutTextureCoordinatesTheWayOutIsSaid)
{
    GltfFile file = scenes::texturedSquare();
    file.primitive()["attributes"].erase("TEXCOORD_0");
    expectRefused(file, "mesh \"square\" has no texture coordinates (TEXCOORD_0)");
}

TEST_F(WrongGlb, TextureCoordinatesOutsideThePictureRepeatIt)
{
    std::vector<glm::vec2> uvs = scenes::squareUvs();
    for (glm::vec2& uv : uvs) uv += glm::vec2(-7.0f, 12.0f);
    expectTaken(squareWith("TEXCOORD_0", uvs), "");
}

TEST_F(WrongGlb, OverlappingTextureCoordinatesAreRefusedWithTheirShare)
{
    GltfFile file = scenes::texturedSquare();
    file.addNode({{"mesh", 0}, {"translation", {5, 0, 0}}});
    expectRefused(file, "50.00 % of its texels stand for several places");
}

TEST_F(WrongGlb, AMissingPictureIsNamed)
{
    GltfFile file = scenes::texturedSquare();
    file.document["images"][0] = {{"uri", "gone.png"}};
    expectRefused(file, "gone.png");
}

TEST_F(WrongGlb, APictureThatClaimsMoreThanItHoldsIsRefused)
{
    for (const uint32_t side : {65535u, 65537u}) {
        GltfFile file = scenes::texturedSquare();
        file.document["images"][0]["bufferView"] = file.addView(scenes::pngClaiming(side, side));
        expectRefused(file, "image 0");
    }
}

TEST_F(WrongGlb, BasisUniversalIsRefusedWithTheCommandThatConvertsIt)
{
    GltfFile file = scenes::texturedSquare();
    file.document["extensionsUsed"] = file.document["extensionsRequired"] = {"KHR_texture_basisu"};
    file.document["images"][0]["mimeType"] = "image/ktx2";
    file.document["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 0;
    file.document["textures"][0].erase("source");
    expectRefused(file, "npx @gltf-transform/cli ktxdecompress in.glb out.glb");
}

TEST_F(WrongGlb, JsonWithoutEndIsRefused)
{
    GltfFile file = scenes::texturedSquare();
    file.document["extras"] = "here";
    write("room.glb", replaced(file.glb(), "\"here\"", "[[[[[["));
    RunInFolder::expectRefused("room.glb", "");
}

TEST_F(WrongPly, AbsurdCountsAreRefused)
{
    for (const SmallScan& ply : {smallTextPly(), smallBinaryPly()})
        for (const char* count : {"vertex 4", "face 2"}) {
            const std::string absurd =
                std::string(count, std::string(count).size() - 1) + std::to_string(kAbsurd);
            write("room.ply", replaced(ply.bytes, count, absurd));
            expectRefused("room.ply", "announces 4000000000");
        }
    write("room.ply", replaced(smallTextPly().bytes, "3 0 1 2", "4000000000 0 1 2"));
    expectRefused("room.ply", "ends before all that its header announces");
}

TEST_F(WrongPly, IndicesOutOfRangeAreRefused)
{
    write("room.ply", replaced(smallTextPly().bytes, "3 2 1 3", "3 2 1 4"));
    expectRefused("room.ply", "refers to vertex 4, and it has 4");
    write("room.ply", replaced(smallTextPly().bytes, "3 2 1 3", "3 2 1 -1"));
    expectRefused("room.ply", "");
}

TEST_F(WrongPly, VerticesThatAreNoPlaceAreRefused)
{
    for (const char* bad : {"nan 0 0", "-1e300 0 0", "1e999 0 0"}) {
        write("room.ply", replaced(smallTextPly().bytes, "1 1 0", bad));
        expectRefused("room.ply", "1 of its 4 vertices lie at no place");
    }
}

TEST_F(WrongPly, HeadersThatAreNotOfPlyAreRefused)
{
    write("room.ply", replaced(smallTextPly().bytes, "format", "fromat"));
    expectRefused("room.ply", "\"fromat\"");
    write("room.ply", replaced(smallTextPly().bytes, "1.0", "2.0"));
    expectRefused("room.ply", "version \"2.0\"");
    for (const SmallScan& ply : {smallTextPly(), smallBinaryPly()}) {
        write("room.ply", replaced(ply.bytes, "face 2", "face 1"));
        expectRefused("room.ply", "behind all that its header announces");
    }
}

TEST_F(WrongPly, FilesOutsideOfItsFolderAreNotRead)
{
    write(smallTexturedPly("png"));
    std::filesystem::create_directory(folder / "scan");
    write("scan/room.ply", replaced(smallTexturedPly("png").bytes, "room.png", "../room.png"));
    expectRefused("scan/room.ply", "--allow-outside");
}

TEST_F(WrongPly, WithoutFacesItIsRefused)
{
    std::string points = replaced(smallTextPly().bytes, "face 2", "face 0");
    write("room.ply", points.substr(0, points.find("\n3 ") + 1));
    expectRefused("room.ply", "point cloud");
}

TEST_F(WrongObj, IndicesOutOfRangeAreRefused)
{
    SmallScan obj = smallObj();
    obj.bytes = replaced(obj.bytes, "f 3/3/1 2/2/1 4/4/1", "f 3/3/1 2/2/1 4000000000/4/1");
    write(obj);
    expectResultOrSentence("room.obj");
    obj.bytes = replaced(smallObj().bytes, "f 1/1/1 2/2/1 3/3/1\nf 3/3/1 2/2/1 4/4/1",
                         "f 11/1/1 12/2/1 13/3/1");
    write(obj);
    expectRefused("room.obj", "");
}

TEST_F(WrongObj, NumbersThatMeanNothingAreRefused)
{
    for (const char* bad : {"nan", "inf", "1e39"}) {
        SmallScan obj = smallObj();
        obj.bytes = replaced(obj.bytes, "v 1 1 0", std::string("v 1 ") + bad + " 0");
        write(obj);
        expectRefused("room.obj", "1 of its 4 vertices lie at no place");
    }
    for (const char* bad : {"1e15", "1e19", "1e37"}) {
        SmallScan obj = smallObj();
        obj.bytes = replaced(obj.bytes, "vt 1 1", std::string("vt 1 ") + bad);
        write(obj);
        expectRefused("room.obj", "1 of its 4 vertices have texture coordinates");
    }
}

TEST_F(WrongObj, FilesOutsideOfItsFolderAreNotRead)
{
    write(smallObj());
    std::filesystem::create_directory(folder / "scan");
    write("scan/room.obj", replaced(smallObj().bytes, "room.mtl", "../room.mtl"));
    expectRefused("scan/room.obj", "room.mtl\", which lies outside");
    write("scan/room.obj", smallObj().bytes);
    write("scan/room.mtl", replaced(smallObj().beside.at("room.mtl"), "room.jpg", "../room.jpg"));
    expectRefused("scan/room.obj", "--allow-outside");
}

TEST_F(WrongObj, WhatIsMissingBesideItIsNamed)
{
    write(smallObj());
    std::filesystem::remove(folder / "room.jpg");
    expectRefused("room.obj", "room.jpg");
    std::filesystem::remove(folder / "room.mtl");
    expectRefused("room.obj", "room.mtl");
}

TEST_F(WrongObj, WithoutTextureCoordinatesTheWayOutIsSaid)
{
    SmallScan obj = smallObj();
    obj.bytes = replaced(obj.bytes, "f 1/1/1 2/2/1 3/3/1\nf 3/3/1 2/2/1 4/4/1", "f 1 2 3\n");
    write(obj);
    expectRefused("room.obj", "has a texture but no texture coordinates");
}

TEST_F(WrongPicture, IsNamed)
{
    write(smallObj());
    const std::string jpeg = smallPicture("jpeg");
    const std::string png = smallPicture("png");
    std::string huge = jpeg; // height and width stand behind the frame's marker
    const size_t frame = huge.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    huge.replace(frame + 5, 4, "\xff\xff\xff\xff");
    for (const std::string& bytes : {jpeg.substr(0, jpeg.size() / 2), png.substr(0, png.size() / 2),
                                     huge, std::string("no picture"), std::string()}) {
        write("room.jpg", bytes);
        expectRefused("room.obj", "room.jpg: ");
    }
}

} // namespace relamp::malformed
