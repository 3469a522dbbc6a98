#include "scan/scan_limits.h"

#include "scan/gltf_read.h"
#include "scan/ply_read.h"
#include "scenes/gltf_files.h"
#include "scenes/pictures.h"
#include "scenes/refusal.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using scenes::GltfFile;
using scenes::refusalOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::span<const std::byte> bytesOf(const std::string& text)
{
    return std::as_bytes(std::span(text));
}

Scan read(const GltfFile& file)
{
    Progress progress;
    return readGltf(bytesOf(file.glb()), "room.glb", {}, progress);
}

std::string refusalBy(const GltfFile& file)
{
    return refusalOf([&] { read(file); });
}

/// Of so many triangles, none of which has an area: any that were read would go one by one.
GltfFile meshOf(size_t triangles)
{
    GltfFile file = scenes::coloredSquare();
    const std::vector<uint16_t> indices(3 * triangles, 0);
    file.primitive()["indices"] = file.addAccessor(scenes::bytesOf(indices), indices.size(),
                                                   {.componentType = 5123, .type = "SCALAR"});
    return file;
}

void standAt(GltfFile& file, size_t nodes)
{
    json list = json::array();
    for (size_t i = 0; i < nodes; ++i) list.push_back(i);
    file.document["nodes"] = json(nodes, json{{"mesh", 0}});
    file.document["scenes"][0]["nodes"] = std::move(list);
}

} // namespace

// Sixty thousand nodes are few, and a thousand triangles are; together they took 6 GB.
TEST(ScanLimits, TrianglesAreCountedAtEveryNodeBeforeAnyIsRead)
{
    GltfFile file = meshOf(1000);
    standAt(file, 60'000);
    EXPECT_THAT(refusalBy(file), HasSubstr("triangles, each mesh counted at each of its nodes"));
    standAt(file, 100);
    EXPECT_THAT(refusalBy(file), HasSubstr("no triangles")); // as they have no area
}

TEST(ScanLimits, MeshesAreCountedAtEveryNode)
{
    GltfFile file = scenes::coloredSquare();
    standAt(file, kMostMeshes + 1);
    EXPECT_THAT(refusalBy(file), HasSubstr("has more than 65536 meshes"));
}

TEST(ScanLimits, MeshesThatAreLeftOutDoNotCount)
{
    GltfFile file = scenes::coloredSquare();
    standAt(file, kMostMeshes + 1);
    file.document["meshes"].push_back(file.document["meshes"][0]);
    file.document["meshes"][0]["name"] = "chair";
    file.document["meshes"][1]["name"] = "room";
    file.document["nodes"][0]["mesh"] = 1;
    Progress progress;
    const Scan scan =
        readGltf(bytesOf(file.glb()), "room.glb", {.skipMeshes = {"chair"}}, progress);
    EXPECT_EQ(scan.meshes.size(), 1u);
}

// A list's item takes ten times its text in memory, and twice.
TEST(ScanLimits, ListsOfAGltfAreLimited)
{
    for (const char* key : {"nodes", "accessors", "bufferViews", "materials", "cameras"}) {
        GltfFile file = scenes::coloredSquare();
        file.document[key] = json(kMostItems + 1, json::object());
        EXPECT_THAT(refusalBy(file), HasSubstr(std::string("has 262145 ") + key)) << key;
    }
    GltfFile file = scenes::coloredSquare();
    json& primitives = file.document["meshes"][0]["primitives"];
    primitives = json(kMostItems + 1, primitives[0]);
    EXPECT_THAT(refusalBy(file), HasSubstr("has 262145 primitives"));
}

// Each of them is looked through when the scan is written.
TEST(ScanLimits, AccessorsThatLieOnTheSameBytesAreLimited)
{
    GltfFile file = meshOf(100'000);
    json& accessors = file.document["accessors"];
    const json many = accessors.back();
    for (size_t i = 0; i < 30; ++i) accessors.push_back(many);
    EXPECT_THAT(refusalBy(file), HasSubstr("accessors announce more than"));
}

TEST(ScanLimits, ADeepChainOfNodesIsNoHarm)
{
    constexpr size_t kDepth = 100'000;
    GltfFile file = scenes::coloredSquare();
    json nodes = json::array();
    for (size_t i = 0; i + 1 < kDepth; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    file.document["nodes"] = std::move(nodes);
    file.document["scenes"][0]["nodes"] = {0};
    EXPECT_EQ(read(file).triangleCount(), 2u);
}

TEST(ScanLimits, PagesAreLimited)
{
    EXPECT_THAT(refusalOf([] { PagePixels(kMostPages + 1, 1, "room.glb"); }),
                HasSubstr("room.glb: has 4097 textures"));
    EXPECT_THAT(refusalOf([] { PagePixels(kMostPages, 1, "room.glb"); }), IsEmpty());
}

// 500 pictures of 512 x 512 in one colour fit into 120 KB, and took over a minute.
TEST(ScanLimits, PixelsOfAllPagesAreBoundedByTheirBytes)
{
    const auto addAll = [](size_t pages, size_t side, uint64_t bytes) {
        return refusalOf([&] {
            PagePixels pixels(pages, bytes, "room.glb");
            for (size_t i = 0; i < pages; ++i) pixels.add(side * side);
        });
    };
    EXPECT_THAT(addAll(500, 512, 120'000), HasSubstr("more than 41 million pixels together"));
    EXPECT_THAT(addAll(500, 512, 4'000'000), IsEmpty());
    EXPECT_THAT(addAll(2, 4096, 1000), IsEmpty());
    EXPECT_THAT(addAll(65, 8192, 1'000'000'000), HasSubstr("more than 4294 million pixels"));
    EXPECT_THAT(addAll(1, 8192, 1000), IsEmpty()); // alone, it is readImage() that looks at it
}

TEST(ScanLimits, OfManyNotesTheFirstAreSaid)
{
    std::vector<std::string> notes(kMostWarnings + 7, "a note");
    shortenWarnings(notes);
    EXPECT_EQ(notes.size(), kMostWarnings + 1);
    EXPECT_EQ(notes.back(), "and 7 more such notes on the scan");
}

// Every texture had a copy of all vertices.
TEST(ScanLimits, TexturesOfAPlyTakeTheirOwnVertices)
{
    constexpr size_t kParts = 4000;
    constexpr size_t kVertices = 200'000;
    std::string text = "ply\nformat ascii 1.0\nelement vertex 200000\nproperty float x\n"
                       "property float y\nproperty float z\nproperty uchar red\nproperty uchar "
                       "green\nproperty uchar blue\nelement face 4000\nproperty list uchar int "
                       "vertex_indices\nproperty int texnumber\nend_header\n";
    for (size_t i = 0; i < kVertices; ++i)
        text += i % 3 == 0 ? "0 0 0 9 9 9\n" : i % 3 == 1 ? "1 0 0 9 9 9\n" : "0 1 0 9 9 9\n";
    for (size_t i = 0; i < kParts; ++i) text += "3 0 1 2 " + std::to_string(i) + "\n";
    Progress progress;
    const Scan scan = readPly(bytesOf(text), "room.ply", {}, progress);
    EXPECT_EQ(scan.meshes.size(), 1u); // no picture tells them apart
    EXPECT_EQ(scan.triangleCount(), kParts);
}

} // namespace relamp
