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
