#include "output/usd_text.h"

#include "relamp/error.h"
#include "scenes/temporary_folder.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

std::string textIn(const std::filesystem::path& file)
{
    std::ostringstream all;
    all << std::ifstream(file).rdbuf();
    return all.str();
}

} // namespace

TEST(UsdText, NamesOfPrimsAreWordsInWhateverVersion)
{
    EXPECT_EQ(primName("ceiling lamp 2"), "ceiling_lamp_2");
    EXPECT_EQ(primName("2nd floor"), "_2nd_floor");
    EXPECT_EQ(primName("K\xc3\xbc"
                       "che"),
              "K_che"); // one character, one '_'
    EXPECT_EQ(primName("a\"b\\c/d.e"), "a_b_c_d_e");
    EXPECT_EQ(primName(""), "unnamed");
    EXPECT_EQ(primName("\xe9\x83\xa8\xe5\xb1\x8b"), "unnamed");
}

TEST(UsdText, NamesThatStandBesideEachOtherAreUnlike)
{
    PrimNames names;
    EXPECT_EQ(names.take("wall"), "wall");
    EXPECT_EQ(names.take("wall"), "wall_2");
    EXPECT_EQ(names.take("wall 2"), "wall_2_2");
    EXPECT_EQ(names.take("wall"), "wall_3");
}

TEST(UsdText, StringsSayWhatTheySaidAndAreUtf8)
{
    EXPECT_EQ(usdString("K\xc3\xbc"
                        "che \xf0\x9f\x92\xa1"),
              "\"K\xc3\xbc"
              "che \xf0\x9f\x92\xa1\"");
    EXPECT_EQ(usdString("a\"b\\c\nd\te\x01"), R"("a\"b\\c\nd\te\x01")");
    EXPECT_EQ(usdString("a\xff"
                        "b\xc3"),
              "\"a\xef\xbf\xbd"
              "b\xef\xbf\xbd\"");
    EXPECT_EQ(usdString("\xed\xa0\x80"), "\"\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\""); // a surrogate
    EXPECT_EQ(usdString("\xc0\xaf"), "\"\xef\xbf\xbd\xef\xbf\xbd\"");                 // overlong
}

// Every 97531st float there is, and those at the ends.
TEST(UsdText, NumbersAreReadAsTheFloatsThatTheyWere)
{
    const auto again = [](float value) {
        const std::string text = usd(value);
        float read = 0.0f;
        std::from_chars(text.data(), text.data() + text.size(), read);
        return read;
    };
    for (uint64_t bits = 0; bits < uint64_t{1} << 32; bits += 97531) {
        const auto value = std::bit_cast<float>(static_cast<uint32_t>(bits));
        if (!std::isfinite(value)) continue;
        ASSERT_EQ(again(value), value) << usd(value);
    }
    for (const float value : {std::numeric_limits<float>::max(), std::numeric_limits<float>::min(),
                              std::numeric_limits<float>::denorm_min(), 0.1f, 16777216.0f})
        EXPECT_EQ(again(-value), -value);
    EXPECT_EQ(usd(0.1f), "0.1");
    EXPECT_EQ(usd(-0.0f), "0");
    EXPECT_EQ(usd(glm::vec3(1.0f, -0.5f, 1e-9f)), "(1, -0.5, 1e-09)");
}

TEST(UsdText, ArraysAndBracesAreWrittenWhole)
{
    const scenes::TemporaryFolder folder;
    UsdText text(folder / "a.usda");
    text.open("def Mesh \"a\"");
    text.array("point3f[] points", std::vector<glm::vec3>{{0, 1, 2}, {3, 4, 5.5f}});
    text.array("texCoord2f[] primvars:st", std::vector<glm::vec2>{{0, 1}});
    text.interpolation("vertex");
    text.array("int[] faceVertexIndices", std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}});
    text.array("int[] faceVertexCounts", 2, 3);
    text.array("point3f[] none", std::span<const glm::vec3>());
    text.close();
    text.finish();
    EXPECT_EQ(textIn(folder / "a.usda"), "def Mesh \"a\"\n{\n"
                                         "    point3f[] points = [(0, 1, 2), (3, 4, 5.5)]\n"
                                         "    texCoord2f[] primvars:st = [(0, 1)] (\n"
                                         "        interpolation = \"vertex\"\n"
                                         "    )\n"
                                         "    int[] faceVertexIndices = [0, 1, 2, 2, 1, 3]\n"
                                         "    int[] faceVertexCounts = [3, 3]\n"
                                         "    point3f[] none = []\n}\n");
}

// More than the buffer holds.
TEST(UsdText, LongArraysLoseNothing)
{
    const scenes::TemporaryFolder folder;
    constexpr uint32_t kMany = 300000;
    std::vector<glm::uvec3> values;
    for (uint32_t i = 0; i < kMany; ++i) values.emplace_back(i, i + 1, i + 2);
    UsdText text(folder / "a.usda");
    text.array("int[] a", values);
    text.finish();
    std::string expected = "int[] a = [";
    for (uint32_t i = 0; i < kMany; ++i)
        expected += (i > 0 ? ", " : "") + std::to_string(i) + ", " + std::to_string(i + 1) + ", " +
                    std::to_string(i + 2);
    EXPECT_TRUE(textIn(folder / "a.usda") == expected + "]\n");
}

TEST(UsdText, ADiskThatIsFullIsSaid)
{
    UsdText text("/dev/full");
    text.line("#usda 1.0");
    EXPECT_THROW(text.finish(), Error);
    EXPECT_THROW(UsdText("/nowhere/a.usda"), Error);
}

} // namespace relamp
