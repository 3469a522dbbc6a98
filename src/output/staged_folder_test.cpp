#include "output/staged_folder.h"

#include "base/file.h"
#include "relamp/error.h"

#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

namespace relamp
{
namespace fs = std::filesystem;
namespace
{

class StagedFolderTest : public testing::Test
{
protected:
    StagedFolderTest()
    {
        std::string pattern = (fs::temp_directory_path() / "relamp-test-XXXXXX").string();
        root = mkdtemp(pattern.data());
    }
    ~StagedFolderTest() override { fs::remove_all(root); }

    [[nodiscard]] std::vector<std::string> entries(const fs::path& folder) const
    {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    fs::path root;
    Progress progress;
};

} // namespace

TEST_F(StagedFolderTest, NothingIsThereBeforeCommitAndAllAfter)
{
    StagedFolder staged(root / "out", progress);
    writeFile(staged / "a.txt", std::string("a"));
    writeFile(staged / "report.json", std::string("{}"));
    EXPECT_FALSE(fs::exists(root / "out"));
    staged.commit("report.json", {});
    EXPECT_THAT(entries(root / "out"), testing::ElementsAre("a.txt", "report.json"));
    EXPECT_THAT(entries(root), testing::ElementsAre("out"));
}

TEST_F(StagedFolderTest, WithoutCommitNothingIsLeft)
{
    {
        const StagedFolder staged(root / "out", progress);
        writeFile(staged / "a.txt", std::string("a"));
    }
    EXPECT_TRUE(entries(root).empty());
}

TEST_F(StagedFolderTest, WithoutCommitFoldersAroundItGoThatWereMadeForIt)
{
    fs::create_directory(root / "mine");
    {
        const StagedFolder staged(root / "mine/a/b/out", progress);
    }
    EXPECT_THAT(entries(root), testing::ElementsAre("mine"));
    EXPECT_TRUE(entries(root / "mine").empty());
    StagedFolder staged(root / "a/out", progress);
    writeFile(staged / "report.json", std::string("{}"));
    staged.commit("report.json", {});
    EXPECT_THAT(entries(root / "a"), testing::ElementsAre("out"));
}

TEST_F(StagedFolderTest, ReplacesItsOwnFilesAndLeavesOthers)
{
    fs::create_directory(root / "out");
    writeFile(root / "out" / "mine.txt", std::string("a person's"));
    writeFile(root / "out" / "albedo.1.exr", std::string("of a former run"));
    writeFile(root / "out" / "albedo.png", std::string("old"));
    StagedFolder staged(root / "out", progress);
    writeFile(staged / "albedo.png", std::string("new"));
    writeFile(staged / "report.json", std::string("{}"));
    staged.commit("report.json", {"albedo.1.exr", "albedo.png"});
    EXPECT_THAT(entries(root / "out"),
                testing::ElementsAre("albedo.png", "mine.txt", "report.json"));
    EXPECT_EQ(readFile(root / "out" / "albedo.png").size(), 3u);
}

TEST_F(StagedFolderTest, RefusesAPlaceThatIsAFile)
{
    writeFile(root / "out", std::string("a file"));
    EXPECT_THROW(StagedFolder(root / "out", progress), Error);
    EXPECT_THROW(StagedFolder(root / "out" / "below", progress), Error);
    EXPECT_THROW(StagedFolder("", progress), Error);
}

TEST_F(StagedFolderTest, GoesWhenTheProcessHasToEnd)
{
    const StagedFolder staged(root / "out", progress);
    writeFile(staged / "a.txt", std::string("a"));
    progress.abandon();
    EXPECT_TRUE(entries(root).empty());
}

} // namespace relamp
