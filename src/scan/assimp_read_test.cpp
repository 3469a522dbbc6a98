#include "scan/assimp_read.h"

#include "scenes/pictures.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A square of one metre that faces z; v = 0 at its lower edge, as OBJ has it.
constexpr const char* kSquare = "o wall\n"
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                                "usemtl paint\n"
                                "f 1/1 2/2 3/3\nf 3/3 2/2 4/4\n";

class AssimpRead : public testing::Test
{
protected:
    void SetUp() override
    {
        folder.write("four colors.png", scenes::pictureFile("png", scenes::fourColors()));
    }

    Scan read(const std::string& name = "room.obj", const ScanOptions& options = {})
    {
        Progress progress;
        return readScan(folder / name, options, progress);
    }
    std::string refusal(const std::string& name = "room.obj")
    {
        return scenes::refusalOf([&] { read(name); });
    }
    void writeSquare(const std::string& mtl)
    {
        folder.write("room.obj", std::string("mtllib room.mtl\n") + kSquare);
        folder.write("room.mtl", mtl);
    }

    TemporaryFolder folder;
};

glm::vec2 uvAt(const Mesh& mesh, glm::vec3 position)
{
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        if (mesh.positions[i] == position) return mesh.uvs[i];
    return glm::vec2(-1.0f);
}

} // namespace

TEST_F(AssimpRead, AnObjKeepsItsPlaceAndItsPictureStandsUpright)
{
    writeSquare("newmtl paint\nmap_Kd four colors.png\n");
    const Scan scan = read();
    ASSERT_THAT(scan.meshes, SizeIs(1));
    const Mesh& mesh = scan.meshes[0];
    EXPECT_EQ(mesh.name, "wall");
    EXPECT_THAT(mesh.triangles, SizeIs(2));
    EXPECT_EQ(uvAt(mesh, {0, 0, 0}), glm::vec2(0, 1)); // the lower edge shows the last row
    EXPECT_EQ(uvAt(mesh, {1, 1, 0}), glm::vec2(1, 0));
    EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_EQ(Radiance(scan.pages.at(0).image)[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(scan.gltf, nullptr);
}

TEST_F(AssimpRead, OptionsQuotesAndSpacesAroundATextureAreUnderstood)
{
    for (const char* line :
         {"map_Kd four colors.png", "map_Kd -s 1 1 1 -o 0 0 0 four colors.png",
          "map_Kd -clamp on four colors.png", "map_Kd -bm 1 -mm 0 1 four colors.png",
          "map_Kd   four colors.png  ", "map_Kd \"four colors.png\"", "map_Kd .\\four colors.png",
          "map_Kd C:\\scans\\four colors.png", "map_Kd four colors.png\r"}) {
        writeSquare(std::string("newmtl paint\nKd 0.5 0.5 0.5\n") + line + "\n");
        EXPECT_EQ(refusal(), "") << line;
    }
}

TEST_F(AssimpRead, ClampIsTakenFromTheMaterial)
{
    writeSquare("newmtl paint\nmap_Kd -clamp on four colors.png\n");
    EXPECT_EQ(read().meshes[0].wrapU, Wrap::clamp);
    writeSquare("newmtl paint\nmap_Kd four colors.png\n");
    EXPECT_EQ(read().meshes[0].wrapU, Wrap::repeat);
}

TEST_F(AssimpRead, MaterialsWithTheirOwnPicturesArePages)
{
    folder.write("grey.png",
                 scenes::pictureFile("png", scenes::Pixels<uint8_t>{1, 1, 3, {9, 9, 9}}));
    folder.write("room.obj",
                 std::string("mtllib room.mtl\n") + kSquare +
                     "o floor\nusemtl wood\nf 1/1 2/2 3/3\no shelf\nusemtl paint\nf 1/1 2/2 4/4\n");
    folder.write("room.mtl",
                 "newmtl paint\nmap_Kd four colors.png\nnewmtl wood\nmap_Kd grey.png\n");
    const Scan scan = read();
    ASSERT_THAT(scan.meshes, SizeIs(3));
    EXPECT_THAT(scan.pages, SizeIs(2));
    for (const Mesh& mesh : scan.meshes)
        EXPECT_EQ(scan.pages[static_cast<size_t>(mesh.page)].name,
                  mesh.name == "floor" ? "grey.png" : "four colors.png");
}

TEST_F(AssimpRead, AMissingPictureIsNamedWithItsMaterial)
{
    writeSquare("newmtl paint\nmap_Kd gone.jpg\n");
    EXPECT_THAT(
        refusal(),
        HasSubstr(
            "room.obj: material \"paint\" names the texture \"gone.jpg\", which is not there"));
}

TEST_F(AssimpRead, AMissingMaterialFileIsNamed)
{
    folder.write("room.obj", std::string("mtllib my gone.mtl\r\n") + kSquare);
    EXPECT_THAT(refusal(),
                HasSubstr("room.obj: names the material file \"my gone.mtl\", which is not there"));
}

TEST_F(AssimpRead, AMissingMaterialFileIsOnlyWarnedOfWhereVerticesHaveColours)
{
    folder.write("room.obj",
                 "mtllib gone.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    const Scan scan = read();
    EXPECT_TRUE(scan.pages.at(0).ofVertices);
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("gone.mtl")));
}

TEST_F(AssimpRead, VertexColoursOfAnObjAreSrgb)
{
    folder.write("room.obj", "v 0 0 0 0.5 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    const Scan scan = read();
    const Radiance radiance(scan.pages.at(0).image);
    EXPECT_NEAR(radiance[0].r, 0.2140f, 1e-4f);
    EXPECT_EQ(radiance[1], glm::vec3(0, 1, 0));
}

TEST_F(AssimpRead, PolygonsBecomeTriangles)
{
    folder.write("room.obj",
                 "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3 4\n");
    EXPECT_THAT(read().meshes[0].triangles, SizeIs(2));
}

TEST_F(AssimpRead, ATextureWithoutCoordinatesIsRefused)
{
    folder.write("room.obj", "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    folder.write("room.mtl", "newmtl paint\nmap_Kd four colors.png\n");
    EXPECT_THAT(refusal(), HasSubstr("has a texture but no texture coordinates"));
}

TEST_F(AssimpRead, ASurfaceWithoutAnyColourIsRefused)
{
    folder.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(refusal(), HasSubstr("has neither textures nor vertex colours"));
}

TEST_F(AssimpRead, BrokenNumbersAndIndicesEndInASentence)
{
    for (const char* text :
         {"f 1 2 3\n", "v nan nan nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "v 0 0 0\nf 1 1 99999999\n",
          "v 0 0 0\nf -5 -6 -7\n", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "hello\n"}) {
        folder.write("room.obj", std::string(text));
        EXPECT_THAT(refusal(), HasSubstr("room.obj")) << text;
    }
}

TEST_F(AssimpRead, FilesOutsideOfItsFolderAreNotRead)
{
    std::filesystem::create_directory(folder / "scan");
    std::filesystem::create_symlink(folder / "four colors.png", folder / "scan/link.png");
    folder.write("far.mtl", std::string("newmtl paint\nmap_Kd wall.png\n"));
    folder.write("scan/wall.png", scenes::pictureFile("png", scenes::fourColors()));
    const auto expectRefused = [&](const std::string& mtllib, const std::string& named) {
        folder.write("scan/room.obj", "mtllib " + mtllib + "\n" + kSquare);
        EXPECT_THAT(refusal("scan/room.obj"), HasSubstr(named + "\", which lies outside"));
        EXPECT_THAT(refusal("scan/room.obj"), HasSubstr("--allow-outside"));
        EXPECT_THAT(read("scan/room.obj", {.allowOutside = true}).pages, SizeIs(1));
    };
    for (const std::string& texture : {std::string("../four colors.png"), std::string("link.png"),
                                       (folder / "four colors.png").string()}) {
        folder.write("scan/near.mtl", "newmtl paint\nmap_Kd " + texture + "\n");
        expectRefused("near.mtl", texture);
    }
    expectRefused("../far.mtl", "../far.mtl");
}

TEST_F(AssimpRead, AScanMayItselfBeALink)
{
    std::filesystem::create_directory(folder / "scan");
    writeSquare("newmtl paint\nmap_Kd four colors.png\n");
    std::filesystem::rename(folder / "room.obj", folder / "scan/real.obj");
    std::filesystem::create_symlink(folder / "scan/real.obj", folder / "room.obj");
    EXPECT_THAT(read().pages, SizeIs(1));
}

TEST_F(AssimpRead, TextureCoordinatesThatTellNoPixelAreRefused)
{
    for (const char* bad : {"1e37", "1e19", "1e15", "nan", "-inf", "1e99", "1e999"}) {
        writeSquare("newmtl paint\nmap_Kd four colors.png\n");
        folder.write("room.obj",
                     "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 " +
                         std::string(bad) + "\nusemtl paint\nf 1/1 2/2 3/3\n");
        EXPECT_THAT(refusal(),
                    testing::ContainsRegex("1 of its 3 (vertices have )?texture coordinates"))
            << bad;
    }
}

TEST_F(AssimpRead, AMaterialThatIsNoColourIsRefused)
{
    folder.write("room.obj", std::string("mtllib room.mtl\n") + kSquare);
    folder.write("room.mtl", std::string("newmtl paint\nKd -1 1 1\n"));
    EXPECT_THAT(refusal(), HasSubstr("the colour of its material is not from 0"));
}

// Other formats that Assimp knows go the same way; this one holds everything in one text file.
TEST_F(AssimpRead, FormatsThatNobodyKnowsAreNamedAsSuch)
{
    folder.write("room.xyz", std::string("what is this\n"));
    EXPECT_THAT(refusal("room.xyz"), HasSubstr("room.xyz: cannot be read: No suitable reader"));
}

} // namespace relamp
