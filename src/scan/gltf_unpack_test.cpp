#include "scan/gltf_unpack.h"

#include "scenes/gltf_files.h"
#include "scenes/pictures.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using scenes::Bytes;
using scenes::GltfFile;
using scenes::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

std::string base64(const Bytes& bytes)
{
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

Scan readFrom(const std::filesystem::path& file, const ScanOptions& options = {})
{
    Progress progress;
    return readScan(file, options, progress);
}

void expectSquare(const Scan& scan)
{
    ASSERT_THAT(scan.meshes, SizeIs(1));
    EXPECT_EQ(scan.meshes[0].positions, scenes::squarePositions());
    EXPECT_EQ(scan.meshes[0].uvs, scenes::squareUvs());
    EXPECT_EQ(Radiance(scan.pages.at(0).image)[1], glm::vec3(0, 1, 0));
}

/// The textured square with its picture at `uri`.
GltfFile squareShowing(const std::string& uri)
{
    GltfFile file = scenes::texturedSquare();
    file.document["images"][0] = {{"uri", uri}, {"name", "wall"}};
    return file;
}

} // namespace

TEST(GltfUnpack, BuffersMayLieInTheTextAsDataUris)
{
    const GltfFile file = scenes::texturedSquare();
    expectSquare(scenes::read(
        file.gltf("data:application/gltf-buffer;base64," + base64(file.binary)), {}, "a.gltf"));
    expectSquare(scenes::read(file.gltf("data:;base64," + base64(file.binary)), {}, "a.gltf"));
}

TEST(GltfUnpack, PicturesMayLieInTheTextAsDataUris)
{
    const auto png = scenes::pictureFile("png", scenes::fourColors());
    expectSquare(scenes::read(squareShowing("data:image/png;base64," + base64(png)).glb()));
}

TEST(GltfUnpack, FilesBesideAreFoundUnderTheirEscapedNames)
{
    const TemporaryFolder folder;
    const GltfFile file = squareShowing("maps/gr%C3%BCne%20wand.png");
    std::filesystem::create_directory(folder / "maps");
    folder.write("maps/gr\xc3\xbcne wand.png", scenes::pictureFile("png", scenes::fourColors()));
    folder.write("the room.bin", file.binary);
    folder.write("room.gltf", file.gltf("the%20room.bin"));
    expectSquare(readFrom(folder / "room.gltf"));
}

/// A scan in a folder, and a picture that lies beside that folder.
class GltfOutside : public testing::Test
{
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder / "scan/a");
        folder.write("secret.png", scenes::pictureFile("png", scenes::fourColors()));
    }
    std::filesystem::path writeShowing(const std::string& uri) const
    {
        return folder.write("scan/room.glb", squareShowing(uri).glb());
    }

    TemporaryFolder folder;
};

TEST_F(GltfOutside, PicturesAreNotRead)
{
    std::filesystem::create_symlink(folder / "secret.png", folder / "scan/link.png");
    std::filesystem::create_directory_symlink(folder.path(), folder / "scan/up");
    for (const std::string& uri :
         {std::string("../secret.png"), std::string("%2e%2E/secret%2epng"),
          std::string("./a/../../secret.png"), (folder / "secret.png").string(),
          std::string("link.png"), std::string("up/secret.png"),
          std::string("up/scan/../secret.png")}) {
        const std::filesystem::path file = writeShowing(uri);
        const std::string sentence = scenes::refusalOf([&] { readFrom(file); });
        EXPECT_THAT(sentence, testing::StartsWith(file.string() + ": image 0 names the file \"" +
                                                  uri + "\", which lies outside"));
        EXPECT_THAT(sentence, HasSubstr("--allow-outside"));
        expectSquare(readFrom(file, {.allowOutside = true}));
    }
}

TEST_F(GltfOutside, BuffersAreNotRead)
{
    const GltfFile square = scenes::texturedSquare();
    folder.write("room.bin", square.binary);
    const auto file = folder.write("scan/room.gltf", square.gltf("../room.bin"));
    EXPECT_THAT(scenes::refusalOf([&] { readFrom(file); }),
                HasSubstr("buffer 0 names the file \"../room.bin\", which lies outside"));
    expectSquare(readFrom(file, {.allowOutside = true}));
}

TEST_F(GltfOutside, PicturesThatShowNoColourAreNotReadEither)
{
    GltfFile file = scenes::texturedSquare();
    file.document["images"].push_back({{"uri", "../secret.png"}});
    const auto room = folder.write("scan/room.glb", file.glb());
    EXPECT_THAT(scenes::refusalOf([&] { readFrom(room); }), HasSubstr("image 1 names the file"));
}

TEST_F(GltfOutside, WhatIsCalledSoButLiesInsideIsRead)
{
    folder.write("scan/wall.png", scenes::pictureFile("png", scenes::fourColors()));
    for (const std::string& uri :
         {std::string("../scan/wall.png"), (folder / "scan/wall.png").string()})
        expectSquare(readFrom(writeShowing(uri)));
    std::filesystem::create_symlink(writeShowing("wall.png"), folder / "link.glb");
    folder.write("wall.png", scenes::pictureFile("png", scenes::fourColors()));
    expectSquare(readFrom(folder / "link.glb")); // whose folder is the link's
}

TEST_F(GltfOutside, OtherSchemesAreNoFiles)
{
    for (const std::string& uri :
         {std::string("http://localhost/secret.png"), "file://" + (folder / "secret.png").string()})
        for (const bool allowOutside : {false, true})
            EXPECT_THAT(scenes::refusalOf(
                            [&] { readFrom(writeShowing(uri), {.allowOutside = allowOutside}); }),
                        HasSubstr("missing or unreadable"))
                << uri;
}

TEST_F(GltfOutside, NamesWithACharacterThatEndsThemAreRefused)
{
    folder.write("scan/wall.png", scenes::pictureFile("png", scenes::fourColors()));
    for (const char* uri : {"wall.png%00", "..%00/secret.png"})
        EXPECT_THAT(scenes::refusalOf([&] { readFrom(writeShowing(uri)); }),
                    HasSubstr("names the file"));
}

TEST(GltfUnpack, AMissingBufferIsNamed)
{
    const std::string sentence =
        scenes::refusal(scenes::texturedSquare().gltf("gone.bin"), "room.gltf");
    EXPECT_THAT(sentence, HasSubstr("room.gltf: buffer 0 needs another file"));
    EXPECT_THAT(sentence, HasSubstr("gone.bin: no such file"));
}

TEST(GltfUnpack, AMissingPictureIsNamedWhereItIsNeeded)
{
    EXPECT_THAT(
        scenes::refusal(squareShowing("gone.png").glb()),
        HasSubstr("room.glb: image 0 \"wall\": the picture file that it names is missing or "
                  "unreadable: gone.png"));
}

TEST(GltfUnpack, AMissingPictureThatShowsNoColourIsOnlyWarnedOf)
{
    GltfFile file = scenes::texturedSquare();
    file.document["images"].push_back({{"uri", "bumps.png"}});
    file.document["textures"].push_back({{"source", 1}});
    file.material()["normalTexture"]["index"] = 1;
    const Scan scan = scenes::read(file.glb());
    expectSquare(scan);
    EXPECT_THAT(scan.warnings, ElementsAre(HasSubstr("bumps.png")));
}

TEST(GltfUnpack, WhatWasCompressedIsPlainAndNoLongerSaysSo)
{
    for (const GltfFile& file : {scenes::dracoSquare(), scenes::meshoptSquare()}) {
        const json document = unpackGltf(scenes::asBytes(file.glb()), "room.glb", {}).document;
        EXPECT_THAT(document.dump(), Not(HasSubstr("compression")));
        EXPECT_THAT(document["buffers"], SizeIs(1));
        EXPECT_FALSE(document.contains("extensionsRequired"));
    }
}

// A stream of zeros packs sixty-four times; named a thousand times it would fill any memory from a
// file of some hundred kilobytes.
TEST(GltfUnpack, AStreamNamedOverAndOverIsRefused)
{
    constexpr size_t kCount = 1 << 20;
    const std::vector<glm::vec3> zeros(kCount, glm::vec3(0.0f));
    Bytes stream(meshopt_encodeVertexBufferBound(kCount, sizeof(glm::vec3)));
    stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), zeros.data(), kCount,
                                             sizeof(glm::vec3)));
    GltfFile file = scenes::texturedSquare();
    const size_t view = file.addView(stream);
    const json compressed{{"buffer", 0},
                          {"byteOffset", file.document["bufferViews"][view]["byteOffset"]},
                          {"byteLength", stream.size()},
                          {"count", kCount},
                          {"byteStride", sizeof(glm::vec3)},
                          {"mode", "ATTRIBUTES"}};
    for (int i = 0; i < 1000; ++i)
        file.document["bufferViews"].push_back(
            {{"buffer", 0},
             {"byteLength", kCount * sizeof(glm::vec3)},
             {"extensions", {{"EXT_meshopt_compression", compressed}}}});
    EXPECT_THAT(scenes::refusal(file.glb()),
                HasSubstr("unpacks to far more than a file of its size can hold"));
}

TEST(GltfUnpack, DamagedStreamsAreRefused)
{
    GltfFile draco = scenes::dracoSquare();
    const json view = draco.document["bufferViews"].back();
    for (size_t i = 11; i < view["byteLength"]; ++i)
        draco.binary[view["byteOffset"].get<size_t>() + i] = 0xff;
    EXPECT_THAT(scenes::refusal(draco.glb()),
                HasSubstr("mesh 0 \"square\": its Draco data is damaged"));

    GltfFile meshopt = scenes::meshoptSquare();
    const json stream = meshopt.document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"];
    meshopt.binary[stream["byteOffset"].get<size_t>()] ^= 0xff;
    EXPECT_THAT(scenes::refusal(meshopt.glb()),
                HasSubstr("bufferView 1: its meshopt data is damaged"));
}

TEST(GltfUnpack, CountsThatNoStreamCouldHoldAreRefusedBeforeThereIsRoomForThem)
{
    GltfFile file = scenes::meshoptSquare();
    file.document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["count"] =
        4'000'000'000u;
    EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("breaks the rules"));
}

TEST(GltfUnpack, ScenesThatAreNotThereAreRefused)
{
    for (const nlohmann::json& scene :
         {nlohmann::json(-1), nlohmann::json(1), nlohmann::json(4294967296), nlohmann::json(1e10),
          nlohmann::json(18446744073709551615u), nlohmann::json("0")}) {
        GltfFile file = scenes::texturedSquare();
        file.document["scene"] = scene;
        EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("scene")) << scene;
    }
}

// Found by the fuzzer: without scenes the nodes themselves are looked through for roots.
TEST(GltfUnpack, NodesThatAreNoListAreRefused)
{
    GltfFile file = scenes::texturedSquare();
    file.document.erase("scenes");
    file.document["nodes"] = 0;
    EXPECT_THAT(scenes::refusal(file.glb()), HasSubstr("\"nodes\" must be a list"));
}

TEST(GltfUnpack, OlderVersionsAreNamed)
{
    GltfFile file = scenes::texturedSquare();
    file.document["asset"]["version"] = "1.0";
    EXPECT_THAT(scenes::refusal(file.glb()),
                HasSubstr("is glTF version 1.0; relamp reads version 2"));
    std::string glb = scenes::texturedSquare().glb();
    glb[4] = 1;
    EXPECT_THAT(scenes::refusal(glb), HasSubstr("is glTF version 1; relamp reads version 2"));
    EXPECT_THAT(scenes::refusal("{}", "a.gltf"), HasSubstr("does not say its glTF version"));
}

} // namespace relamp
