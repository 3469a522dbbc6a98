#include "relamp/printable.h"

#include "relamp/error.h"

#include <gmock/gmock.h>

namespace relamp
{

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// Titles, colours and the cursor are set by what follows an escape character, or 0x9b alone.
TEST(Printable, NoTerminalIsToldAnything)
{
    EXPECT_EQ(printableName("a\x1b]0;mine\x07z"), "a\\x1b]0;mine\\x07z");
    EXPECT_EQ(printableName("one\ntwo\r\tthree\x7f"), "one\\x0atwo\\x0d\\x09three\\x7f");
    EXPECT_EQ(printableName("\xc2\x9b"
                            "31m"),
              "\\x9b31m"); // as U+009b
    EXPECT_EQ(printableName("\x9b"
                            "31m"),
              "\\x9b31m"); // as a byte
}

// A name that is written from right to left shows "exe.gltf" where "ftlg.exe" stands.
TEST(Printable, NothingIsTurnedRoundOrHidden)
{
    EXPECT_EQ(printableName("room\u202eflt.glb"), "room\\u202eflt.glb");
    EXPECT_EQ(printableName("a\u2066b\u200bc\u2028"), "a\\u2066b\\u200bc\\u2028");
    EXPECT_EQ(printableName("\U000e0041"), "\\U000e0041");
}

TEST(Printable, WhatIsNoUtf8IsToldByItsBytes)
{
    EXPECT_EQ(printableName("\xff\xc0\xafx"), "\\xff\\xc0\\xafx"); // never; too long for a '/'
    EXPECT_EQ(printableName("\xe2\x82"), "\\xe2\\x82");            // cut off
    EXPECT_EQ(printableName("\xed\xa0\x80"), "\\xed\\xa0\\x80");   // half of a pair of UTF-16
    EXPECT_EQ(printableName("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80"); // beyond Unicode
}

TEST(Printable, LettersOfAllPeopleStay)
{
    const std::string name = "Küche 台所 кухня 👩‍🍳 \\x";
    EXPECT_EQ(printableName(name), name);
    EXPECT_EQ(printableText(printableText("a\x1b\n")), "a\\x1b\n"); // twice is as once
}

TEST(Printable, NamesEndAfterAHandfulOfLines)
{
    const std::string cut = printableName(std::string(1'000'000, 'x'));
    EXPECT_EQ(cut.size(), kPrintedName + 3);
    EXPECT_THAT(cut, EndsWith("xx..."));
    EXPECT_EQ(printableName("äöü", 2), "äö...");
    EXPECT_EQ(printableName("äö", 2), "äö");
}

// Whatever a file is called by: what is wrong stays in view, and the way out.
TEST(Printable, SentencesKeepTheirBeginningAndTheirEnd)
{
    std::string sentence = "a.glb: mesh ";
    sentence.append(1'000'000, 'x').append(": has no texture.\nUnwrap it");
    const std::string text = printableText(sentence);
    EXPECT_THAT(text, StartsWith("a.glb: mesh xxx"));
    EXPECT_THAT(text, HasSubstr("xxx...xxx"));
    EXPECT_THAT(text, EndsWith("xxx: has no texture.\nUnwrap it"));
    EXPECT_LT(text.size(), 1000u);
    EXPECT_EQ(printableText(text), text);
    EXPECT_LT(printableText(std::string(1'000'000, '\n')).size(), 5000u);
    EXPECT_LT(printableText(std::string(1'000'000, '\xff')).size(), 5000u);
}

// Whoever throws it need not think of it, and whoever catches it may print it.
TEST(Printable, EveryErrorIs)
{
    const Error error(ErrorCode::malformed, "a.glb: mesh \"\x1b[2J\": no.\nGo out");
    EXPECT_STREQ(error.what(), "a.glb: mesh \"\\x1b[2J\": no.\nGo out");
    EXPECT_THAT(std::string(Error(ErrorCode::malformed, std::string(100'000, '\x1b')).what()),
                StartsWith("\\x1b\\x1b"));
}

} // namespace relamp
