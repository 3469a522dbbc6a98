#include "base/json_lines.h"

#include <gmock/gmock.h>

namespace relamp
{

TEST(JsonLines, EveryKeyAndItemHasItsLine)
{
    const JsonLines lines("{\n \"lights\": [\n  {\"a\": 1},\n  {\n   \"b\": [1,\n    2]\n  }\n ],\n"
                          " \"end\": \"x\\ny\"\n}\n");
    EXPECT_EQ(lines.at("/lights"), 2);
    EXPECT_EQ(lines.at("/lights/0"), 3);
    EXPECT_EQ(lines.at("/lights/0/a"), 3);
    EXPECT_EQ(lines.at("/lights/1"), 4);
    EXPECT_EQ(lines.at("/lights/1/b"), 5);
    EXPECT_EQ(lines.at("/end"), 9);
}

TEST(JsonLines, WhatIsNotThereIsWhereItsSurroundingsAre)
{
    const JsonLines lines("{\n\"lights\": [\n{}]}");
    EXPECT_EQ(lines.at("/lights/0/position"), 3);
    EXPECT_EQ(lines.at("/sky"), 1);
}

} // namespace relamp
