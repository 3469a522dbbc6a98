#include "base/json.h"

#include "relamp/error.h"

#include <ctime>
#include <string>

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

namespace
{

/// Seconds of a processor that a list of so many objects takes to parse.
double secondsToParse(int objects)
{
    std::string list = "{\"nodes\": [{}";
    for (int i = 1; i < objects; ++i) list += ",{}";
    list += "]}";
    const std::clock_t start = std::clock();
    EXPECT_EQ(parseJson(list, "")["nodes"].size(), static_cast<size_t>(objects));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

} // namespace

// nlohmann's parser with a callback looks at all former elements of an array again at each one's
// end: eight times the list took 64 times as long.
TEST(Json, LongListsTakeNoLongerThanTheyAreLong)
{
    EXPECT_LT(secondsToParse(160'000), 24.0 * secondsToParse(20'000));
}

// nlohmann throws where a text is no UTF-8, unless it is told what to do.
TEST(Json, WhatIsWrittenIsValidWhateverNamesAreInIt)
{
    const nlohmann::ordered_json document{{"name", "a\xff\xc0\x1b"}};
    for (const std::string& text : {textOf(document), dumpJson(document)}) {
        EXPECT_EQ(nlohmann::json::parse(text)["name"], "a\ufffd\ufffd\x1b");
        EXPECT_EQ(text.find('\x1b'), std::string::npos);
    }
}

} // namespace relamp
