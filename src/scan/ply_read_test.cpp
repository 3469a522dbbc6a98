#include "scan/ply_read.h"

#include "scenes/gltf_files.h"
#include "scenes/pictures.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::TemporaryFolder;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const std::string kColoredVertices =
    "element vertex 4\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::string kFaces = "element face 2\nproperty list uchar int vertex_indices\n";

std::string ascii(const std::string& header, const std::string& body)
{
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

std::string coloredSquare()
{
    return ascii(kColoredVertices + kFaces,
                 "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n1 1 0 188 188 188\n"
                 "3 0 1 2\n3 2 1 3\n");
}

/// Appends numbers to a binary body, in either order of bytes.
struct Body
{
    bool bigEndian = false;
    std::string bytes;

    template<class Number>
    void add(std::initializer_list<Number> numbers)
    {
        for (Number number : numbers) {
            char raw[sizeof(Number)];
            std::memcpy(raw, &number, sizeof raw);
            if (bigEndian) std::reverse(raw, raw + sizeof raw);
            bytes.append(raw, sizeof raw);
        }
    }
};

std::string binarySquare(bool bigEndian)
{
    Body body{bigEndian, {}};
    const auto vertices = scenes::squarePositions();
    const std::array<std::array<uint8_t, 3>, 4> colors{
        {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {188, 188, 188}}};
    for (size_t i = 0; i < 4; ++i) {
        body.add<float>({vertices[i].x, vertices[i].y, vertices[i].z});
        body.add<uint8_t>({colors[i][0], colors[i][1], colors[i][2]});
    }
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, {2, 1, 3}}) {
        body.add<uint8_t>({3});
        body.add<int32_t>({a, b, c});
    }
    const std::string format = bigEndian ? "binary_big_endian" : "binary_little_endian";
    return "ply\r\nformat " + format + " 1.0\r\n" + kColoredVertices + kFaces + "end_header\r\n" +
           body.bytes;
}

Scan readFile(const TemporaryFolder& folder, const std::string& text)
{
    folder.write("grey.png",
                 scenes::pictureFile("png", scenes::Pixels<uint8_t>{1, 1, 3, {9, 9, 9}}));
    folder.write("four colors.png", scenes::pictureFile("png", scenes::fourColors()));
    Progress progress;
    return readScan(folder.write("room.ply", text), {}, progress);
}

} // namespace

TEST(PlyRead, ColouredVerticesComeInEveryEncoding)
{
    for (const std::string& file : {coloredSquare(), binarySquare(false), binarySquare(true)}) {
        const Scan scan = scenes::read(file, {}, "room.ply");
        ASSERT_THAT(scan.meshes, SizeIs(1));
        EXPECT_EQ(scan.meshes[0].positions, scenes::squarePositions());
        EXPECT_THAT(scan.meshes[0].triangles,
                    ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(2, 1, 3)));
        EXPECT_THAT(scan.meshes[0].normals, Each(glm::vec3(0, 0, 1)));
        const Radiance radiance(scan.pages.at(0).image);
        EXPECT_EQ(radiance[1], glm::vec3(0, 1, 0));
        EXPECT_NEAR(radiance[3].g, 0.5028f, 3e-4f); // bytes are sRGB
    }
}

TEST(PlyRead, TransferLinearLeavesColoursAsTheyAre)
{
    const Scan scan = scenes::read(coloredSquare(), {.transfer = Transfer::linear}, "room.ply");
    EXPECT_NEAR(Radiance(scan.pages[0].image)[3].g, 188.0f / 255.0f, 3e-4f);
}

TEST(PlyRead, UpZStandsTheRoomOnItsFloor)
{
    const Scan scan = scenes::read(coloredSquare(), {.up = UpAxis::z, .scale = 2.0}, "room.ply");
    EXPECT_EQ(scan.meshes[0].positions[3], glm::vec3(2, 0, -2));
    EXPECT_THAT(scan.meshes[0].normals, Each(glm::vec3(0, 1, 0)));
}

TEST(PlyRead, CoordinatesOfVerticesShowThePictureTheHeaderNames)
{
    const TemporaryFolder folder;
    const Scan scan = readFile(
        folder, ascii("comment TextureFile four colors.png\nelement vertex 3\nproperty double x\n"
                      "property double y\nproperty double z\nproperty float s\n"
                      "property float t\nelement face 1\n"
                      "property list uchar uint vertex_index\n",
                      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"));
    EXPECT_THAT(scan.meshes.at(0).uvs,
                ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0)));
    EXPECT_EQ(scan.pages.at(0).name, "four colors.png");
    EXPECT_EQ(scan.meshes[0].page, 0);
}

// At a seam the faces on either side show different places of the picture: the two vertices that
// they share must become four.
TEST(PlyRead, CoordinatesOfCornersTearTheMeshAtItsSeamsAndOnlyThere)
{
    const TemporaryFolder folder;
    const std::string header =
        "comment TextureFile four colors.png\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nelement face 2\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\n";
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    const Scan torn = readFile(
        folder, ascii(header, vertices + "3 0 1 2 6 0 0 0.5 0 0 1\n3 2 1 3 6 0.5 1 1 0 1 1\n"));
    ASSERT_THAT(torn.meshes.at(0).positions, SizeIs(6));
    const Mesh& mesh = torn.meshes[0];
    const auto corner = [&](size_t triangle, int c) { return mesh.triangles[triangle][c]; };
    EXPECT_EQ(mesh.positions[corner(0, 2)], mesh.positions[corner(1, 0)]);
    EXPECT_EQ(mesh.uvs[corner(0, 2)], glm::vec2(0, 0));
    EXPECT_EQ(mesh.uvs[corner(1, 0)], glm::vec2(0.5f, 0));

    const Scan whole = readFile(
        folder, ascii(header, vertices + "3 0 1 2 6 0 0 1 0 0 1\n3 2 1 3 6 0 1 1 0 1 1\n"));
    EXPECT_THAT(whole.meshes.at(0).positions, SizeIs(4));
}

TEST(PlyRead, FacesMayComeInSeveralListsOnlySomeWithCoordinates)
{
    const TemporaryFolder folder;
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const Scan scan = readFile(
        folder, ascii("comment TextureFile four colors.png\nelement vertex 4\nproperty float x\n"
                      "property float y\nproperty float z\n" +
                          faces + faces + "property list uchar float texcoord\n",
                      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 2 1 3 6 0 0.5 1 0 1 1\n"));
    EXPECT_THAT(scan.meshes.at(0).triangles, SizeIs(2));
    EXPECT_THAT(scan.meshes[0].positions, SizeIs(6));
}

TEST(PlyRead, FacesMayShowSeveralPictures)
{
    const TemporaryFolder folder;
    const Scan scan = readFile(
        folder,
        ascii(
            "comment TextureFile four colors.png\ncomment TextureFile grey.png\nelement vertex 4\n"
            "property float x\nproperty float y\nproperty float z\nelement face 2\n"
            "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
            "property int texnumber\n",
            "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 6 0 0 1 0 0 1 1\n3 2 1 3 6 0 1 1 0 1 1 0\n"));
    ASSERT_THAT(scan.meshes, SizeIs(2));
    const auto pictureOf = [&](size_t mesh) {
        return scan.pages.at(static_cast<size_t>(scan.meshes[mesh].page)).name;
    };
    EXPECT_EQ(pictureOf(0), "grey.png");
    EXPECT_EQ(pictureOf(1), "four colors.png");
}

TEST(PlyRead, PolygonsAreFannedAndOtherElementsPassedOver)
{
    const Scan scan = scenes::read(
        ascii("comment made by hand\nelement camera 1\nproperty float fov\nproperty list uchar "
              "float more\n" +
                  kColoredVertices +
                  "element face 1\nproperty list uchar int vertex_indices\nproperty uchar flags\n",
              "50 2 1 2\n0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 1 1 1\n4 0 1 2 3 7\n"),
        {}, "room.ply");
    EXPECT_THAT(scan.meshes.at(0).triangles, ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
}

TEST(PlyRead, APointCloudIsToldFromASurface)
{
    EXPECT_THAT(scenes::refusal(
                    ascii(kColoredVertices, "0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 1 1 1\n"),
                    "a.ply"),
                HasSubstr("a.ply: has 4 points but no faces: it is a point cloud"));
}

TEST(PlyRead, APictureWithoutCoordinatesAndCoordinatesWithoutAPictureAreRefused)
{
    const std::string vertices =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    EXPECT_THAT(scenes::refusal(ascii("comment TextureFile a.png\n" + vertices + face,
                                      "0 0 0 1 0 0 0 1 0 3 0 1 2"),
                                "a.ply"),
                HasSubstr("names a picture but has no texture coordinates"));
    EXPECT_THAT(scenes::refusal(ascii(vertices + "property float u\nproperty float v\n" + face,
                                      "0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 3 0 1 2"),
                                "a.ply"),
                HasSubstr("has texture coordinates but names no picture"));
    EXPECT_THAT(scenes::refusal(ascii(vertices + face, "0 0 0 1 0 0 0 1 0 3 0 1 2"), "a.ply"),
                HasSubstr("has neither textures nor vertex colours"));
}

TEST(PlyRead, AMissingPictureIsNamed)
{
    EXPECT_THAT(scenes::refusal(
                    ascii("comment TextureFile gone.png\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nproperty float u\nproperty float v\n"
                          "element face 1\nproperty list uchar int vertex_indices\n",
                          "0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 3 0 1 2"),
                    "a.ply"),
                HasSubstr("a.ply: its header names the texture \"gone.png\", which is not there"));
}

TEST(PlyRead, NumbersThatMeanNothingAreRefused)
{
    for (const char* bad : {"nan inf 0", "1e999 0 0", "-1e300 0 0", "5e5 4e6 0"})
        EXPECT_THAT(scenes::refusal(ascii(kColoredVertices + kFaces,
                                          "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n" +
                                              std::string(bad) + " 1 1 1\n3 0 1 2\n3 2 1 3\n"),
                                    "a.ply"),
                    HasSubstr("a.ply: mesh \"a\": 1 of its 4 vertices lie at no place"))
            << bad;
    EXPECT_EQ(
        scenes::refusal(ascii(kColoredVertices + kFaces, "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n"
                                                         "1 1 1e-999 1 1 1\n3 0 1 2\n3 2 1 3\n"),
                        "a.ply"),
        "");
}

TEST(PlyRead, PicturesOutsideOfItsFolderAreNotRead)
{
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scan");
    folder.write("secret.png", scenes::pictureFile("png", scenes::fourColors()));
    std::filesystem::create_symlink(folder / "secret.png", folder / "scan/link.png");
    for (const std::string& name : {std::string("../secret.png"), std::string("..\\secret.png"),
                                    std::string("link.png"), (folder / "secret.png").string()}) {
        const auto file = folder.write(
            "scan/room.ply",
            ascii("comment TextureFile " + name +
                      "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                      "property float s\nproperty float t\nelement face 1\n"
                      "property list uchar int vertex_indices\n",
                  "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"));
        Progress progress;
        EXPECT_THAT(scenes::refusalOf([&] { readScan(file, {}, progress); }),
                    HasSubstr("its header names the file \"" + name + "\", which lies outside"));
        EXPECT_THAT(readScan(file, {.allowOutside = true}, progress).pages, SizeIs(1));
    }
}

TEST(PlyRead, HeadersThatAreNotOfPlyAreRefused)
{
    const std::string good = coloredSquare();
    const auto with = [&](const std::string& what, const std::string& by) {
        std::string text = good;
        text.replace(text.find(what), what.size(), by);
        return scenes::refusal(text, "a.ply");
    };
    EXPECT_EQ(with("ply\n", "ply\nobj_info made by hand\n"), "");
    EXPECT_THAT(with("format", "fromat"),
                HasSubstr("line 2 of its header begins with a word that PLY does not know: "
                          "\"fromat\""));
    EXPECT_THAT(with("ascii 1.0", "ascii 2.0"), HasSubstr("says version \"2.0\" of PLY"));
    EXPECT_THAT(with("ascii 1.0", "ascii"), HasSubstr("says version \"\" of PLY"));
    EXPECT_THAT(with("format ascii 1.0\n", ""), HasSubstr("has no line \"format\""));
    EXPECT_THAT(with("list uchar", "list float"), HasSubstr("counts a list in fractions"));
    EXPECT_THAT(with("3 2 1 3", "3 2 1 2.5"), HasSubstr("refers to vertex"));
}

TEST(PlyRead, MoreThanTheHeaderAnnouncesIsRefused)
{
    std::string fewer = coloredSquare();
    fewer.replace(fewer.find("face 2"), 6, "face 1");
    EXPECT_THAT(scenes::refusal(fewer, "a.ply"),
                HasSubstr("a.ply: goes on for 9 bytes behind all that its header announces"));
    std::string binary = binarySquare(false);
    EXPECT_EQ(scenes::refusal(binary + "\n", "a.ply"), "");
    EXPECT_THAT(scenes::refusal(binary + "more", "a.ply"), HasSubstr("goes on for 4 bytes"));
}

TEST(PlyRead, LiesOfTheHeaderAreFoundBeforeTheyCostMemory)
{
    const auto announcing = [](const std::string& vertices) {
        return ascii("element vertex " + vertices +
                         "\nproperty float x\nproperty float y\nproperty float z\n" + kFaces,
                     "0 0 0\n");
    };
    EXPECT_THAT(scenes::refusal(announcing("4000000000"), "a.ply"),
                HasSubstr("announces 4000000000 of element \"vertex\""));
    EXPECT_THAT(scenes::refusal(announcing("99999999999999999999"), "a.ply"),
                HasSubstr("where a number of elements belongs"));
    EXPECT_THAT(scenes::refusal(announcing("-1"), "a.ply"),
                HasSubstr("where a number of elements belongs"));
    Body body;
    body.add<int32_t>({2'000'000'000});
    EXPECT_THAT(scenes::refusal("ply\nformat binary_little_endian 1.0\nelement face 1\n"
                                "property list int int vertex_indices\nend_header\n" +
                                    body.bytes,
                                "a.ply"),
                HasSubstr("ends before all that its header announces"));
}

TEST(PlyRead, BrokenHeadersEndInASentenceThatNamesTheLine)
{
    EXPECT_THAT(scenes::refusal("ply\nformat ascii 1.0\nelement ver", "a.ply"),
                HasSubstr("its PLY header has no end"));
    EXPECT_THAT(scenes::refusal(ascii("element vertex 1\nproperty quad x\n", ""), "a.ply"),
                HasSubstr("line 4 of its header"));
    EXPECT_THAT(scenes::refusal(ascii("property float x\n", ""), "a.ply"),
                HasSubstr("a property of no element"));
    EXPECT_THAT(scenes::refusal("ply\nformat runes 1.0\nend_header\n", "a.ply"),
                HasSubstr("\"runes\""));
}

TEST(PlyRead, IndicesOutOfRangeAreRefused)
{
    for (const char* face : {"3 0 1 4", "3 0 1 -1", "3 0 1 1e30", "3 0 1 nan"})
        EXPECT_THAT(
            scenes::refusal(
                ascii(kColoredVertices + "element face 1\nproperty list uchar int vertex_indices\n",
                      std::string("0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n1 1 0 1 1 1\n") + face),
                "a.ply"),
            HasSubstr("refers to vertex"))
            << face;
}

} // namespace relamp
