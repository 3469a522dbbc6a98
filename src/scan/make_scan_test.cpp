#include "base/half.h"
#include "relamp/delight.h"
#include "relamp/error.h"
#include "relamp/scan.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;

/// Arrays as somebody else has them: a square of two triangles with a texture of 2 x 2 pixels.
struct Arrays
{
    std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
    std::vector<glm::uvec3> triangles{{0, 2, 1}, {1, 2, 3}};
    std::vector<glm::vec2> uvs{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> colors;
    std::vector<Image> textures{
        {.width = 2, .height = 2, .transfer = Transfer::srgb, .rgb = std::vector<uint8_t>(12)}};
    int texture = 0;
    std::string name = "square";
    ScanOptions options;

    [[nodiscard]] Scan scan() const
    {
        const SurfaceArrays surface{"floor", texture, positions, triangles, uvs, normals, colors};
        return makeScan(name, std::span(&surface, 1), textures, options);
    }
};

std::string refusalAfter(const std::function<void(Arrays&)>& damage)
{
    Arrays arrays;
    damage(arrays);
    return scenes::refusalOf([&] { static_cast<void>(arrays.scan()); });
}

} // namespace

TEST(MakeScan, IsWhatAFileOfTheSameWouldBe)
{
    const Scan square = scenes::square(1.0f, 4, scenes::plain(glm::vec3(0.25f)));
    const Mesh& mesh = square.meshes[0];
    const SurfaceArrays surface{mesh.name, 0, mesh.positions, mesh.triangles, mesh.uvs, {}, {}};
    const Scan made = makeScan("scene", std::span(&surface, 1), {square.pages[0].image});
    EXPECT_EQ(made.meshes[0].positions, mesh.positions);
    EXPECT_EQ(made.meshes[0].normals, mesh.normals);
    EXPECT_EQ(made.pages[0].image.half(), square.pages[0].image.half());
    EXPECT_THAT(made.warnings, testing::IsEmpty());
}

// The axes and the unit are those of the arrays, as of a file.
TEST(MakeScan, StandsUpInMetres)
{
    Arrays arrays;
    arrays.options = {.up = UpAxis::z, .scale = 0.01};
    arrays.positions = {{0, 0, 0}, {100, 0, 0}, {0, 0, 100}, {100, 0, 100}};
    arrays.normals = std::vector<glm::vec3>(4, {0, 1, 0});
    const Scan scan = arrays.scan();
    EXPECT_EQ(boundsOf(scan).high, glm::vec3(1, 1, 0)); // their z points up
    EXPECT_EQ(scan.meshes[0].normals[0], glm::vec3(0, 0, -1));
}

TEST(MakeScan, ColoursOfVerticesAreAPage)
{
    Arrays arrays;
    arrays.texture = -1;
    arrays.uvs.clear();
    arrays.textures.clear();
    arrays.colors = {glm::vec3(0.5f), glm::vec3(2.0f), glm::vec3(1.0f), glm::vec3(0.0f)};
    const Scan scan = arrays.scan();
    ASSERT_TRUE(scan.pages.at(0).ofVertices);
    EXPECT_EQ(Radiance(scan.pages[0].image)[1], glm::vec3(2.0f));
}

// What nobody watches is asked for without a Progress.
TEST(MakeScan, LeadsToAnAlbedoInOneLine)
{
    EXPECT_EQ(delight(Arrays().scan()).layers(0).width, 2);
}

TEST(MakeScan, SaysWhatIsWrong)
{
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusalAfter([](Arrays&) {}), "");
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.name = "../square"; }), HasSubstr("is no name"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.options.scale = 0.0; }),
                HasSubstr("its scale is 0"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.triangles[1].z = 4; }),
                HasSubstr("square: mesh \"floor\": refers to vertex 4, and it has 4"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.positions[0].x = kNaN; }),
                HasSubstr("1 of its 4 vertices lie at no place"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.uvs.pop_back(); }),
                HasSubstr("one texture coordinate a vertex"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.uvs.clear(); }),
                HasSubstr("no texture coordinates"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.normals.resize(3); }),
                HasSubstr("3 normals for 4 positions"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.texture = 1; }),
                HasSubstr("shows texture 1, and there are 1"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.textures[0].width = 3; }),
                HasSubstr("has 12 values, not 18"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.textures[0].transfer = Transfer::automatic; }),
                HasSubstr("srgb or linear"));
    EXPECT_THAT(refusalAfter([](Arrays& a) {
                    a.textures[0].rgb = std::vector<uint16_t>(12, halfFromFloat(0.5f));
                    a.textures[0].half()[3] = 0xbc00; // -1
                }),
                HasSubstr("texture 0: has values that are no light"));
    EXPECT_THAT(refusalAfter([](Arrays& a) { a.triangles.clear(); }),
                HasSubstr("has no triangles"));
}

} // namespace relamp
