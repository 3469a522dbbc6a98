#include "script.h"

#include "scenes/refusal.h"

#include "relamp/error.h"

#include <gmock/gmock.h>

namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::string complaintOf(const char* text)
{
    return relamp::scenes::refusalOf([&] { parseScript(text, "a.txt"); });
}

TEST(Script, IsCommandsWithWordsAndComments)
{
    const auto commands =
        parseScript("# first\nopen \"my room.glb\" # and this\n\n  press ctrl+z\r\nquit", "a.txt");

    ASSERT_EQ(commands.size(), 3u);
    EXPECT_EQ(commands[0].name, "open");
    EXPECT_THAT(commands[0].words, ElementsAre("my room.glb"));
    EXPECT_EQ(commands[1].line, 4u);
    EXPECT_THAT(commands[1].words, ElementsAre("ctrl+z"));
    EXPECT_THAT(commands[2].words, ElementsAre());
}

TEST(Script, SaysInWhichLineItIsWrong)
{
    EXPECT_THAT(complaintOf("quit\njump 3"), HasSubstr("a.txt line 2: \"jump\" is no command"));
    EXPECT_THAT(complaintOf("open"), HasSubstr("a.txt line 1: it must read: open FILE"));
    EXPECT_THAT(complaintOf("type \"a"), HasSubstr("quotation mark"));
    EXPECT_THAT(complaintOf("click 1"), HasSubstr("click X Y"));
    EXPECT_THAT(complaintOf("stay\nquit"), HasSubstr("a.txt line 2: nothing can follow stay"));
}

TEST(Script, NumbersAreWholeWords)
{
    EXPECT_FLOAT_EQ(numberOf("-1.5"), -1.5f);
    for (const char* word : {"", "1x", "nan", "inf", "one", "1e99"})
        EXPECT_THROW(static_cast<void>(numberOf(word)), relamp::Error) << word;
    // To the last one: a float would make 4294967296 of it.
    EXPECT_EQ(wholeNumberOf("4294967295"), 4294967295u);
    for (const char* word : {"", "-1", "1.5", "4294967296", "one"})
        EXPECT_THROW(static_cast<void>(wholeNumberOf(word)), relamp::Error) << word;
}

} // namespace
