#include "relamp/page.h"

#include "base/file.h"
#include "base/half.h"
#include "image/light_meter.h"
#include "image/view_transform.h"
#include "output/web_geometry.h"
#include "relight/photometry.h"
#include "scan/gltf_uri.h"
#include "scenes/lit_room.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

glm::vec3 vectorFrom(const json& list)
{
    return {list[0].get<float>(), list[1].get<float>(), list[2].get<float>()};
}

/// The lit room of the tests under its panel and a sky, and a folder with files of a viewer.
class WebPage : public testing::Test
{
protected:
    WebPage() : room(scenes::litDelitRoom("panel </script>\"7\""))
    {
        lighting = asCaptured(room.captured);
        lighting.sky.radiance = {0.1f, 0.2f, 0.4f};
        std::filesystem::create_directory(folder / "viewer");
        for (const char* name :
             {"index.html", "viewer.css", "viewer.js", "relamp-room.js", "licences.txt"})
            folder.write(std::string("viewer/") + name, name);
        options.viewer = folder / "viewer";
    }

    WrittenPage write()
    {
        Relighter relighter(room, {.rays = 16});
        return writePage(relighter, lighting, folder / "page", options);
    }

    [[nodiscard]] json list() const
    {
        std::ifstream file(folder / "page/room.json");
        return json::parse(file);
    }

    DelitRoom room;
    Relighting lighting;
    PageOptions options;
    const scenes::TemporaryFolder folder;
};

} // namespace

TEST_F(WebPage, HasALightmapOfEachLightInAScriptAndTheViewer)
{
    const WrittenPage written = write();
    const json page = list();
    EXPECT_EQ(page["format"], "relamp page 1");
    EXPECT_EQ(written.lights, 2u);
    ASSERT_EQ(page["lights"].size(), 2u);
    EXPECT_EQ(page["lights"][0]["name"], "panel </script>\"7\"");
    EXPECT_EQ(page["lights"][0]["kind"], "lamp");
    EXPECT_EQ(page["lights"][0]["shines"][0]["place"], 0);
    EXPECT_EQ(page["lights"][1]["kind"], "sky");
    EXPECT_EQ(vectorFrom(page["lights"][1]["colour"]), lighting.sky.radiance);
    EXPECT_EQ(page["probes"]["scales"].size(), 2u);
    EXPECT_GT(page["bounces"]["clusters"], 50);
    uint64_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder / "page"))
        if (file.path().filename() != "room.json") bytes += file.file_size();
    EXPECT_EQ(written.bytes, bytes);
    for (const char* name : {"viewer.js", "index.html", "preview.jpg", "room.js", "scan.js",
                             "bounces.js", "probes.js"})
        EXPECT_TRUE(std::filesystem::exists(folder / "page" / name)) << name;

    const json part = page["lights"][0]["maps"][0]; // handed over as base64
    EXPECT_EQ(part["type"], "image/webp");
    const auto file = readFile(folder / "page" / (part["file"].get<std::string>() + ".js"));
    const std::string script(reinterpret_cast<const char*>(file.data()), file.size());
    const std::string start = "relampPart(\"" + part["file"].get<std::string>() + "\", \"";
    ASSERT_THAT(script, StartsWith(start));
    const std::string base64 = script.substr(start.size(), script.size() - start.size() - 4);
    const auto jpeg = decodeDataUri("data:image/webp;base64," + base64, "light");
    EXPECT_EQ(jpeg.size(), part["bytes"].get<size_t>());
    const Image map = readImage(std::as_bytes(std::span(jpeg)), "light");
    EXPECT_EQ(map.width, part["width"].get<int>());
}

TEST_F(WebPage, LeavesAFolderAsItWasWhereTheViewerIsNotThere)
{
    std::filesystem::remove(folder / "viewer/viewer.js");
    EXPECT_THAT(scenes::refusalOf([&] { checkPage(folder / "page", options); }),
                HasSubstr("viewer.js: is not there"));
    EXPECT_THAT(scenes::refusalOf([&] { write(); }), HasSubstr("npm"));
    EXPECT_FALSE(std::filesystem::exists(folder / "page"));
}

TEST_F(WebPage, WithoutAnyLightIsRefused)
{
    lighting = darkened(room.captured);
    EXPECT_THAT(scenes::refusalOf([&] { write(); }), HasSubstr("no light is on"));
    EXPECT_FALSE(std::filesystem::exists(folder / "page"));
}

// A 16-bit share of the box: half a step of it is the most by which a corner may move.
TEST(WebGeometry, HasTheTrianglesOfTheScanToHalfAStep)
{
    const Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 64, scenes::LitRoom::albedo);
    const WebGeometry geometry = webGeometry(scan);
    ASSERT_EQ(geometry.meshes.size(), scan.meshes.size());
    for (size_t m = 0; m < scan.meshes.size(); ++m) {
        const Mesh& mesh = scan.meshes[m];
        const json item = geometry.meshes[m];
        struct Vertex
        {
            uint16_t xyz[3], nothing, uv[2];
        };
        std::vector<Vertex> vertices(item["vertices"].get<size_t>());
        std::vector<uint32_t> corners(3 * item["triangles"].get<size_t>());
        const auto* bytes = geometry.bytes.data();
        ASSERT_EQ(meshopt_decodeVertexBuffer(vertices.data(), vertices.size(), sizeof(Vertex),
                                             bytes + item["vertexData"]["offset"].get<size_t>(),
                                             item["vertexData"]["bytes"].get<size_t>()),
                  0);
        ASSERT_EQ(meshopt_decodeIndexBuffer(corners.data(), corners.size(), sizeof(uint32_t),
                                            bytes + item["indexData"]["offset"].get<size_t>(),
                                            item["indexData"]["bytes"].get<size_t>()),
                  0);
        ASSERT_EQ(corners.size(), 3 * mesh.triangles.size());
        // Triangles are in another order: the sums over all of what is not linear tell them apart.
        glm::dvec3 found(0.0);
        glm::dvec3 wanted(0.0);
        for (const uint32_t corner : corners) {
            const Vertex& v = vertices[corner];
            glm::vec3 p;
            for (int c = 0; c < 3; ++c)
                p[c] = item["box"]["low"][static_cast<size_t>(c)].get<float>() +
                       item["box"]["extent"][static_cast<size_t>(c)].get<float>() *
                           static_cast<float>(v.xyz[c]) / 65535.0f;
            found += glm::dvec3(p * p * static_cast<float>(v.uv[0] + v.uv[1] + 1));
        }
        const float lowU = item["uvBox"]["low"][0].get<float>();
        const float lowV = item["uvBox"]["low"][1].get<float>();
        const float widthU = item["uvBox"]["extent"][0].get<float>();
        const float widthV = item["uvBox"]["extent"][1].get<float>();
        for (const glm::uvec3 t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 p = mesh.positions[t[k]];
                const glm::vec2 uv = mesh.uvs[t[k]];
                const float steps = 65535.0f * ((uv.x - lowU) / widthU + (uv.y - lowV) / widthV);
                wanted += glm::dvec3(p * p * (steps + 1.0f));
            }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / wanted[c], 1.0, 1e-4);
    }
}

// apps/web/test holds the browser's formulas to the same numbers.
class WebFormulas : public testing::Test
{
protected:
    WebFormulas()
    {
        std::ifstream file(std::string(RELAMP_SAMPLES) + "/../apps/web/test/formulas.json");
        numbers = json::parse(file);
    }

    json numbers;
};

TEST_F(WebFormulas, AgxIsAsThePageHasIt)
{
    const ViewTransform agx({.view = View::agx});
    ASSERT_GE(numbers["agx"].size(), 5u);
    for (const json& row : numbers["agx"]) {
        const glm::vec3 shown = agx.displayed(vectorFrom(row["light"]));
        const glm::vec3 apart = glm::abs(shown - vectorFrom(row["shown"]));
        EXPECT_LT(std::max({apart.r, apart.g, apart.b}), 1e-4f)
            << row["light"] << ": " << shown.r << ", " << shown.g << ", " << shown.b;
    }
}

TEST_F(WebFormulas, ExposureIsAsThePageHasIt)
{
    ASSERT_GE(numbers["meter"].size(), 4u);
    for (const json& row : numbers["meter"]) {
        Image picture{.width = static_cast<int>(row["light"].size()), .height = 1};
        auto& half = picture.rgb.emplace<std::vector<uint16_t>>();
        for (const json& rgb : row["light"])
            for (const json& value : rgb) half.push_back(halfFromFloat(value.get<float>()));
        LightMeter meter;
        meter.add(picture);
        EXPECT_NEAR(meter.exposure(), row["stops"].get<float>(), 2e-3f) << row["light"];
    }
}

TEST_F(WebFormulas, BlackbodiesAreAsThePageHasThem)
{
    ASSERT_GE(numbers["blackbody"].size(), 5u);
    for (const json& row : numbers["blackbody"]) {
        const glm::vec3 colour = blackbodyColour(row["kelvin"].get<float>(), PhotometricWhite{});
        const glm::vec3 apart = glm::abs(colour - vectorFrom(row["colour"]));
        EXPECT_LT(std::max({apart.r, apart.g, apart.b}), 1e-4f)
            << row["kelvin"] << ": " << colour.r << ", " << colour.g << ", " << colour.b;
    }
}

} // namespace relamp
