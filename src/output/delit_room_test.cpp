#include "relamp/relight.h"

#include "image/transfer.h"
#include "image/write_image.h"
#include "relamp/result.h"
#include "scan/gltf_write.h"
#include "scenes/gltf_files.h"
#include "scenes/lit_room.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>

namespace relamp
{

// The first row of its texture is red and green, the second blue and white.
TEST(DelitRoom, BaseColourOfAPlainFileIsTextureTimesFactor)
{
    const scenes::TemporaryFolder folder;
    scenes::GltfFile file = scenes::texturedSquare();
    Progress progress;
    const auto albedoOf = [&](const std::string& name) {
        folder.write(name, file.glb());
        return readDelitRoom(folder / name, {.textureIsAlbedo = true}, progress).albedo.at(0);
    };
    const Image plain = albedoOf("plain.glb");
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
    const Image tinted = albedoOf("tinted.glb");
    for (size_t pixel = 0; pixel < 4; ++pixel) {
        const glm::vec3 expected = Radiance(plain)[pixel] * glm::vec3(0.5f, 0.25f, 1.0f);
        EXPECT_EQ(Radiance(tinted)[pixel], expected) << pixel;
    }
}

// A scan that was never delit would be lit twice.
TEST(DelitRoom, AScanIsRefusedUnlessItsTextureIsSaidToBeAnAlbedo)
{
    const scenes::TemporaryFolder folder;
    folder.write("plain.glb", scenes::texturedSquare().glb());
    Progress progress;
    const std::string refusal =
        scenes::refusalOf([&] { readDelitRoom(folder / "plain.glb", {}, progress); });
    EXPECT_THAT(refusal, testing::HasSubstr("relamp delight"));
    EXPECT_THAT(refusal, testing::HasSubstr("--texture-is-albedo"));
}

// Files of albedo have half floats, those of confidence bytes, as the room in memory has them.
TEST(DelitRoom, InMemoryLooksAsFromItsFolder)
{
    const scenes::TemporaryFolder folder;
    const Scan lit = scenes::LitRoom().scan;
    const Image& photo = lit.pages[0].image;
    const Radiance radiance(photo);
    std::vector<uint8_t> bytes;
    for (size_t pixel = 0; pixel < photo.pixels(); ++pixel)
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<uint8_t>(
                std::lround(255.0f * srgbFromLinear(std::min(radiance[pixel][c], 1.0f)))));
    const auto png = encodePng(bytes, {photo.width, photo.height}, 3);
    const auto file =
        folder.write("room.glb", writeUnlitGlb(lit, {{.albedo = {png, "image/png"}}}));

    Progress progress;
    const Decomposition found = delight(
        readScan(file, {}, progress),
        {.gather = {.quality = Quality::draft}, .engine = {.engine = Engine::cpu}}, progress);
    writeResult(found, file, folder / "out", progress);
    const DelitRoom read = readDelitRoom(folder / "out", {}, progress);
    const DelitRoom made = delitRoomOf(found, progress);
    const auto litAnew = [&](const DelitRoom& room) {
        Relighting lighting = darkened(room.captured);
        setFixture(lighting, room.captured, "all=50%");
        return relight(room, lighting, {.rays = 16, .engine = {.engine = Engine::cpu}}, progress)
            .at(0);
    };
    const Image expected = litAnew(read);
    const Image image = litAnew(made);
    const Radiance a(expected);
    const Radiance b(image);
    double light = 0.0;
    double off = 0.0;
    for (size_t pixel = 0; pixel < image.pixels(); ++pixel) {
        light += static_cast<double>(glm::length(a[pixel]));
        off += static_cast<double>(glm::distance(a[pixel], b[pixel]));
    }
    EXPECT_GT(light, 0.01 * static_cast<double>(image.pixels())); // black would agree, too
    // A folder's room sends its rays by the albedo, and this one by the photo.
    EXPECT_LT(off, 0.01 * light);
}

// Wherever it was copied to.
TEST(DelitRoom, AGlbThatRelampWroteTellsItsLights)
{
    const scenes::TemporaryFolder folder;
    const Scan scan = scenes::read(scenes::texturedSquare().glb());
    Lights lights;
    lights.fixtures.push_back(
        {.area = 1.0f, .radiance = glm::vec3(3.0f), .id = 7, .name = "ceiling lamp 7"});
    Progress progress;
    const RelitPage grey{
        .albedo = {encodePng(std::vector<uint8_t>(12, 128), {2, 2}, 3), "image/png"}};
    folder.write("delit.glb", writeGlb(scan, {grey}, lights));
    const DelitRoom room = readDelitRoom(folder / "delit.glb", {}, progress);
    ASSERT_EQ(room.captured.fixtures.size(), 1u);
    EXPECT_EQ(room.captured.fixtures[0].id, 7);
    EXPECT_EQ(room.captured.nameOf(0), "ceiling lamp 7");
    EXPECT_EQ(room.captured.fixtures[0].radiance, glm::vec3(3.0f));
    const ScanOptions otherwise{.up = UpAxis::z};
    const DelitRoom turned = readDelitRoom(folder / "delit.glb", {.asScan = otherwise}, progress);
    EXPECT_TRUE(turned.captured.fixtures.empty());
    EXPECT_FALSE(turned.warnings.empty());
}

} // namespace relamp
