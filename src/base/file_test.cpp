#include "base/file.h"

#include "relamp/error.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::filesystem::path& file, size_t largest = 1 << 20)
{
    return scenes::refusalOf([&] { readFile(file, largest); });
}

} // namespace

TEST(File, BytesComeBackAsTheyWereWritten)
{
    const scenes::TemporaryFolder folder;
    const std::string text("a\0b\r\n\xff", 6);
    writeFile(folder / "bytes", text);
    const std::vector<std::byte> bytes = readFile(folder / "bytes");
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), text);
}

TEST(File, WhatCannotBeReadIsNamedWithItsReason)
{
    const scenes::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder / "gone"), HasSubstr("gone: no such file"));
    EXPECT_THAT(refusal(folder.path()), HasSubstr("is a directory, not a file"));
    EXPECT_THAT(refusal(folder.write("empty", std::string())), HasSubstr("is empty (0 bytes)"));
    EXPECT_THAT(refusal(folder.write("large", std::string(100, 'a')), 99),
                HasSubstr("is larger than"));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(refusal(folder / "pipe"),
                HasSubstr("is not a regular file")); // and nobody waits for it
    EXPECT_THAT(refusal(folder / "empty" / "below"), HasSubstr("no such file"));
}

TEST(File, WhatCannotBeWrittenIsNamedWithItsReason)
{
    const scenes::TemporaryFolder folder;
    folder.write("file", std::string("content"));
    try {
        writeFile(folder / "file" / "below", "text");
        ADD_FAILURE() << "was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cannotWrite);
        EXPECT_THAT(error.what(), HasSubstr("below: cannot be written: Not a directory"));
    }
}

// Nobody knows the hidden folder that a result is written into before it is moved.
TEST(File, WhatCannotBeWrittenIsNamedByThePlaceThatItIsMeantFor)
{
    const scenes::TemporaryFolder folder;
    const std::filesystem::path staged = stageFolder(folder / ".room.v2");
    const std::filesystem::path beside = std::filesystem::path(".none") / "albedo.exr";
    EXPECT_THAT(scenes::refusalOf([&] { writeFile(staged / beside, "text"); }),
                StartsWith((folder / ".room.v2" / beside).string() + ": cannot be written"));
}

} // namespace relamp
