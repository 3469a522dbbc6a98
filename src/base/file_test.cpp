#include "base/file.h"

#include "relamp/error.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

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

// One that was killed cannot; the next that writes there does.
TEST(File, WhatAProcessLeftBehindThatIsNoMoreGoes)
{
    const scenes::TemporaryFolder folder;
    const std::filesystem::path target = folder / "out";
    const pid_t child = fork();
    if (child == 0) {
        writeFile(stageFolder(target) / "half", "text");
        stageFile(target);
        _exit(0); // as if it had been killed
    }
    waitpid(child, nullptr, 0);
    const auto count = [&] {
        return std::distance(std::filesystem::directory_iterator(folder.path()), {});
    };
    EXPECT_EQ(count(), 2);
    const std::filesystem::path mine = stageFolder(target);
    EXPECT_EQ(count(), 1);
    stageFile(target); // and what the living are at stays
    EXPECT_TRUE(std::filesystem::exists(mine));
    EXPECT_EQ(count(), 2);
}

// Ids of another machine say nothing here, nor does what is named otherwise.
TEST(File, WhatAnotherMachineMayBeAtStays)
{
    const scenes::TemporaryFolder folder;
    for (const char* name :
         {".out.relamp-00000000-1-abcdef", ".out.relamp-abcdef", ".other.relamp-00000000-1-abcdef"})
        folder.write(name, std::string("half"));
    const std::filesystem::path staged = stageFolder(folder / "out");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 4);
}

} // namespace relamp
