#include "output/folder_record.h"

#include "output/result_folder.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;
using testing::Not;

/// A folder as a writer leaves it: two files, and the list of them.
void writeListed(const scenes::TemporaryFolder& folder, const std::string& program = "relamp 0.2")
{
    folder.write("a.txt", std::string("a"));
    folder.write("b.txt", std::string("b"));
    const FolderRecord record(folder.path(), "list.json");
    const nlohmann::ordered_json list{{"program", program}, {"files", record.asJson()}};
    folder.write("list.json", list.dump());
}

bool isOurs(const std::string& name)
{
    return name == "a.txt" || name == "list.json" || name == "new.txt";
}

std::string refusalIn(const scenes::TemporaryFolder& folder)
{
    return scenes::refusalOf([&] {
        checkReplaceable(folder.path(), FolderRecord::read(folder.path(), "list.json"), isOurs);
    });
}

} // namespace

TEST(FolderRecord, WhatRelampWroteAndNobodyChangedMayBeReplaced)
{
    const scenes::TemporaryFolder folder;
    writeListed(folder);
    folder.write("other.txt", std::string("nobody writes it"));
    checkReplaceable(folder.path(), FolderRecord::read(folder.path(), "list.json"), isOurs);
    EXPECT_FALSE(FolderRecord::read(folder.path(), "list.json").lists("other.txt"));
}

// b.txt would be removed, for the list names it and it is not written anew.
TEST(FolderRecord, WhatWasChangedSinceOrIsAnothersIsNamedAndKept)
{
    const scenes::TemporaryFolder folder;
    writeListed(folder);
    folder.write("b.txt", std::string("c")); // as long as before
    folder.write("new.txt", std::string("a stranger's"));
    EXPECT_THAT(refusalIn(folder), HasSubstr("b.txt, new.txt"));
    EXPECT_THAT(refusalIn(folder), HasSubstr("--force"));
    EXPECT_THAT(refusalIn(folder), Not(HasSubstr("a.txt")));
}

TEST(FolderRecord, AListOfAnotherProgramSaysNothing)
{
    const scenes::TemporaryFolder folder;
    writeListed(folder, "lister 3");
    EXPECT_THAT(refusalIn(folder), HasSubstr("a.txt, list.json"));
}

TEST(FolderRecord, AListThatIsBrokenSaysNothing)
{
    const scenes::TemporaryFolder folder;
    for (const char* text :
         {"", "{", "[]", "7", R"({"program": 7})", R"({"program": "relamp 0.2", "files": 7})",
          R"({"program": "relamp 0.2", "files": [7, {}, {"name": 7}]})",
          R"({"program": "relamp 0.1", "files": ["a.txt"]})",
          R"({"program": "relamp 0.2", "files": [{"name": "../a.txt"}]})"}) {
        folder.write("a.txt", std::string("a"));
        folder.write("list.json", std::string(text));
        EXPECT_THAT(refusalIn(folder), HasSubstr("a.txt")) << text;
    }
}

TEST(FolderRecord, MarksTellFilesApart)
{
    const scenes::TemporaryFolder folder;
    const auto markOfText = [&](const std::string& text) {
        return markOf(folder.write("file", text));
    };
    EXPECT_EQ(markOfText("abc"), markOfText("abc"));
    EXPECT_NE(markOfText("abc"), markOfText("abd"));
    EXPECT_NE(markOfText("abc"), markOfText(std::string("abc\0", 4)));
    const std::string large(size_t{3} << 20, 'x'); // several chunks
    EXPECT_NE(markOfText(large), markOfText(large + "x"));
    const FileMark mark = markOfText(large);
    EXPECT_EQ(markFrom(nlohmann::json(asJson(mark))), mark);
    EXPECT_FALSE(markFrom(nlohmann::json::parse(R"({"bytes": 1, "checksum": "xyz"})")));
}

TEST(ResultFolder, KnowsTheNamesOfItsFiles)
{
    for (const char* name : {"report.json", "lights.json", "preview.png", "room.glb", "albedo.exr",
                             "albedo.12.png", "reasons.0.png"})
        EXPECT_TRUE(isOfResult(name, "room")) << name;
    for (const char* name : {"other.glb", "albedo.jpg", "albedo.x.exr", "albedo..exr", "albedoexr",
                             "transport.bin", "shading.png", "notes.txt"})
        EXPECT_FALSE(isOfResult(name, "room")) << name;
}

} // namespace relamp
