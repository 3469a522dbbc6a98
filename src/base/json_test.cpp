#include "base/json.h"

#include "relamp/error.h"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{

TEST(Json, BracketsInStringsOpenNothing)
{
    const std::string brackets(300, '[');
    EXPECT_EQ(parseJson(R"({"a\\": ")" + brackets + R"(\"["})", "")["a\\"], brackets + "\"[");
    EXPECT_THROW(parseJson(R"({"a\\": )" + brackets + "}", ""), Error);
}

// nlohmann's parser with a callback looks at all former elements of an array again at each one's
// end: this text took ten seconds.
TEST(Json, LongListsTakeNoLongerThanTheyAreLong)
{
    std::string list = "{\"nodes\": [{}";
    for (int i = 0; i < 200'000; ++i) list += ",{}";
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(parseJson(list + "]}", "")["nodes"].size(), 200'001u);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
}

} // namespace relamp
