// What a result tells of itself, and what of it nobody loses: relamp on drafts of the sample room.

#include "golden/program.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kScan = RELAMP_SAMPLES "/bedroom/scan.glb";

nlohmann::json jsonOf(const fs::path& file)
{
    return nlohmann::json::parse(std::ifstream(file));
}

void append(const fs::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::app) << text;
}

/// A scan and the draft of its result, made once; each test has a copy of both.
class ResultProgram : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        shared = new scenes::TemporaryFolder;
        fs::copy_file(kScan, *shared / "room.glb");
        const Outcome run = runInShell("cd " + shared->path().string() +
                                       " && $RELAMP delight room.glb -o out --quality draft");
        ASSERT_EQ(run.exitCode, 0) << run.err;
        said = run.out;
    }
    static void TearDownTestSuite() { delete shared; }

    void SetUp() override { fs::copy(shared->path(), folder.path(), fs::copy_options::recursive); }

    [[nodiscard]] Outcome delight(const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments{"delight", folder / "room.glb", "-o",   folder / "out",
                                           "-q",      "--quality",         "draft"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runRelamp(arguments);
    }
    /// Where a shell stands and what it does there.
    [[nodiscard]] Outcome inside(const std::string& where, const std::string& command) const
    {
        return runInShell("cd " + (folder / where).string() + " && " + command);
    }
    [[nodiscard]] Outcome relight(const std::string& room,
                                  const std::vector<std::string>& more) const
    {
        std::vector<std::string> arguments{"relight",           folder / room, "--rays", "4",
                                           "--shadow-rays",     "1",           "--bake", "-o",
                                           folder / "baked.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runRelamp(arguments);
    }

    scenes::TemporaryFolder folder;
    static inline scenes::TemporaryFolder* shared = nullptr;
    static inline std::string said;
};

constexpr const char* kVerify = "$RELAMP verify --places 300 --samples 4 ";

} // namespace

TEST_F(ResultProgram, VerifyFindsTheScanFromAnyFolderAndAfterBothWereMoved)
{
    EXPECT_EQ(jsonOf(folder / "out/report.json")["scan"]["file"], "../room.glb");
    const Outcome own = inside("out", std::string(kVerify) + ".");
    EXPECT_EQ(own.exitCode, 0) << own.err;
    EXPECT_THAT(own.out, HasSubstr("against ../room.glb"));
    fs::create_directory(folder / "elsewhere");
    for (const char* name : {"room.glb", "out"})
        fs::rename(folder / name, folder / "elsewhere" / name);
    const Outcome moved = inside(".", std::string(kVerify) + "elsewhere/out");
    EXPECT_EQ(moved.exitCode, 0) << moved.err;
    EXPECT_THAT(moved.out, HasSubstr("against elsewhere/room.glb"));
    EXPECT_THAT(moved.out, HasSubstr("window 0"));
}

TEST_F(ResultProgram, VerifyRefusesAnotherFile)
{
    const Outcome own = inside("out", std::string(kVerify) + ". --scan room.glb");
    EXPECT_EQ(own.exitCode, 1);
    EXPECT_THAT(own.err, HasSubstr("what relamp wrote, not the scan"));
    append(folder / "room.glb", "more");
    const Outcome other = inside(".", std::string(kVerify) + "out");
    EXPECT_EQ(other.exitCode, 1);
    EXPECT_THAT(other.err, HasSubstr("room.glb: is not the scan as it was"));
    EXPECT_THAT(other.err, HasSubstr("--scan FILE"));
}

TEST_F(ResultProgram, DelightKeepsWhatSomebodyEditedUnlessForced)
{
    EXPECT_EQ(delight().exitCode, 0); // again, and nobody has edited anything
    append(folder / "out/lights.json", " ");
    const auto edited = fs::file_size(folder / "out/lights.json");
    const Outcome refused = delight();
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("lights.json"));
    EXPECT_THAT(refused.err, Not(HasSubstr("albedo")));
    EXPECT_EQ(fs::file_size(folder / "out/lights.json"), edited);
    EXPECT_EQ(delight({"--force"}).exitCode, 0);
    EXPECT_NE(fs::file_size(folder / "out/lights.json"), edited);
}

TEST_F(ResultProgram, DelightKeepsAStrangersFiles)
{
    fs::remove_all(folder / "out");
    fs::create_directory(folder / "out");
    append(folder / "out/lights.json", "mine");
    append(folder / "out/notes.txt", "mine, and in nobody's way");
    const Outcome refused = delight();
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("lights.json"));
    EXPECT_THAT(refused.err, Not(HasSubstr("notes.txt")));
    EXPECT_EQ(fs::file_size(folder / "out/lights.json"), 4u);
    EXPECT_FALSE(fs::exists(folder / "out/report.json"));
}

TEST_F(ResultProgram, RelightRefusesAScanThatStillHasItsLight)
{
    const Outcome refused = relight("room.glb", {"--fixture", "all=on"});
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("relamp delight"));
    const Outcome dark = relight("room.glb", {"--fixture", "all=on", "--texture-is-albedo"});
    EXPECT_EQ(dark.exitCode, 0) << dark.err;
    EXPECT_THAT(dark.err, HasSubstr("tells of no lights of its own"));
}

TEST_F(ResultProgram, TheModelOfAResultIsRelitAsTheResult)
{
    ASSERT_EQ(relight("out", {"--fixture", "all=on"}).exitCode, 0);
    fs::rename(folder / "baked.exr", folder / "of_folder.exr");
    const Outcome run = relight("out/room.glb", {"--fixture", "window 0=on", "--fixture", "2=on"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("nothing shines")));
    const auto bytes = [&](const char* name) {
        std::ifstream stream(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    EXPECT_TRUE(bytes("baked.exr") == bytes("of_folder.exr"));
}

TEST_F(ResultProgram, RelightWritesNeitherOverTheScanNorIntoTheResult)
{
    const auto write = [&](const std::string& to) {
        return runRelamp(
            {"relight", folder / "out", "--fixture", "all=on", "--bake", "-o", folder / to});
    };
    const auto before = fs::file_size(folder / "room.glb");
    EXPECT_THAT(write("room.glb").err, HasSubstr("is the scan itself"));
    EXPECT_EQ(fs::file_size(folder / "room.glb"), before);
    EXPECT_THAT(write("out/albedo.exr").err, HasSubstr("is part of what relamp delight wrote"));
}

// The default quality finds one lamp more, and each of the draft's again.
TEST_F(ResultProgram, ALampHasOneNumberAndNameInEveryQualityAndList)
{
    ASSERT_EQ(runRelamp({"delight", folder / "room.glb", "-o", folder / "fine", "-q"}).exitCode, 0);
    const auto namesOf = [&](const nlohmann::json& fixtures) {
        std::map<int, std::string> names;
        for (const auto& fixture : fixtures) names[fixture["id"]] = fixture["name"];
        return names;
    };
    const auto draft = namesOf(jsonOf(folder / "out/lights.json")["fixtures"]);
    const auto fine = namesOf(jsonOf(folder / "fine/lights.json")["fixtures"]);
    EXPECT_EQ(draft, (std::map<int, std::string>{{0, "window 0"}, {2, "ceiling lamp 2"}}));
    for (const auto& [id, name] : draft) EXPECT_EQ(fine.at(id), name);
    EXPECT_EQ(fine.size(), 3u);
    EXPECT_EQ(namesOf(jsonOf(folder / "fine/report.json")["lights"]["fixtures"]), fine);
    EXPECT_THAT(said, HasSubstr("ceiling lamp 2"));
    const Outcome refused = relight("out", {"--fixture", "lamp=on"});
    EXPECT_THAT(refused.err, HasSubstr("window 0, ceiling lamp 2"));
}

// Neither a search nor its time.
TEST_F(ResultProgram, GivenLightsAreTakenAsTheFileSaysAndNothingIsSearched)
{
    nlohmann::json lights = jsonOf(folder / "out/lights.json");
    for (auto& fixture : lights["fixtures"]) fixture["radiance"] = {7.0, 6.0, 5.0};
    lights["ambient"] = {0.25, 0.125, 0.0625};
    std::ofstream(folder / "out/mine.json") << lights;
    const Outcome run = runRelamp({"delight", folder / "room.glb", "-o", folder / "again", "-q",
                                   "--quality", "draft", "--lights", folder / "out/mine.json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const nlohmann::json report = jsonOf(folder / "again/report.json");
    EXPECT_TRUE(jsonOf(folder / "out/report.json")["seconds"]["stages"].contains("lamps"));
    for (const char* stage : {"lamps", "sun"})
        EXPECT_FALSE(report["seconds"]["stages"].contains(stage)) << stage;
    EXPECT_THAT(report["warnings"], testing::IsEmpty());
    const nlohmann::json again = jsonOf(folder / "again/lights.json");
    EXPECT_EQ(again["ambient"], lights["ambient"]);
    ASSERT_EQ(again["fixtures"].size(), lights["fixtures"].size());
    for (size_t i = 0; i < lights["fixtures"].size(); ++i)
        for (const char* key : {"id", "name", "radiance", "area"})
            EXPECT_EQ(again["fixtures"][i][key], lights["fixtures"][i][key]) << key;
    // The same texels are the same lamps'.
    EXPECT_EQ(contentOf(folder / "again/fixtures.png"), contentOf(folder / "out/fixtures.png"));
}

TEST_F(ResultProgram, AnEditedFileInAnotherOrderGivesTheSamePicture)
{
    nlohmann::json lights = jsonOf(folder / "out/lights.json");
    lights["fixtures"][0]["radiance"] = {9.0, 9.0, 9.0};
    std::ofstream(folder / "out/edited.json") << lights;
    std::reverse(lights["fixtures"].begin(), lights["fixtures"].end());
    std::reverse(lights["lights"].begin(), lights["lights"].end());
    std::ofstream(folder / "out/turned.json") << lights;
    std::vector<std::string> pictures;
    for (const char* name : {"edited", "turned"}) {
        const Outcome run =
            relight("out", {"--lights", folder / "out" / (std::string(name) + ".json")});
        ASSERT_EQ(run.exitCode, 0) << run.err;
        pictures.push_back(contentOf(folder / "baked.exr"));
    }
    EXPECT_TRUE(pictures[0] == pictures[1]);
}

// Nor by where one stands: the scan is gone, and so is the folder's old place.
TEST_F(ResultProgram, AFolderStandsByItself)
{
    ASSERT_EQ(relight("out", {"--fixture", "all=on"}).exitCode, 0);
    const std::string before = contentOf(folder / "baked.exr");
    fs::create_directories(folder / "far/away");
    fs::rename(folder / "out", folder / "far/away/result");
    fs::remove(folder / "room.glb");
    fs::remove(folder / "far/away/result/transport.bin");
    const Outcome run =
        inside("far", "$RELAMP relight away/result --rays 4 --shadow-rays 1 --fixture all=on "
                      "--bake -o moved.exr");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("note")));
    EXPECT_TRUE(contentOf(folder / "far/moved.exr") == before);
    const Outcome scan =
        inside("far", "$RELAMP relight away/result --show scan --size 64x36 -o scan.png");
    EXPECT_EQ(scan.exitCode, 1);
    EXPECT_THAT(scan.err, HasSubstr("--scan FILE"));
    EXPECT_EQ(
        inside("far", "$RELAMP relight away/result --show albedo --size 64x36 -o a.png").exitCode,
        0);
}

// They had no numbers.
TEST_F(ResultProgram, ALightsFileOfTheFirstReleaseIsReadByPlaceAndANoteSaysSo)
{
    nlohmann::json lights = jsonOf(folder / "out/lights.json");
    for (auto& fixture : lights["fixtures"])
        for (const char* key : {"id", "name", "unseen"}) fixture.erase(key);
    for (size_t i = 0; i < lights["lights"].size(); ++i) lights["lights"][i]["fixture"] = i;
    std::ofstream(folder / "old.json") << lights;
    const Outcome run = runRelamp({"delight", folder / "room.glb", "-o", folder / "again",
                                   "--quality", "draft", "--lights", folder / "old.json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("have no \"id\""));
    EXPECT_THAT(run.err, HasSubstr("2 by what is burnt out at their place"));
    const Outcome lit = relight("out", {"--lights", folder / "old.json"});
    EXPECT_EQ(lit.exitCode, 0);
    EXPECT_THAT(lit.err, HasSubstr("known by their places"));
    const std::string byPlace = contentOf(folder / "baked.exr");
    ASSERT_EQ(relight("out", {"--lights", folder / "out/lights.json"}).exitCode, 0);
    EXPECT_TRUE(contentOf(folder / "baked.exr") == byPlace);
}

// The chatter is lost, the work is not; what was asked for on standard output is.
TEST_F(ResultProgram, AClosedOutputFailsOnlyWhatIsPrintedThere)
{
    const std::string again = "$RELAMP delight room.glb -o out --quality draft ";
    EXPECT_EQ(inside(".", again + ">&-").exitCode, 0);
    EXPECT_EQ(inside(".", again + ">/dev/full").exitCode, 0);
    for (const char* to : {">&-", ">/dev/full"}) {
        const Outcome json = inside(".", again + "--json " + to);
        EXPECT_EQ(json.exitCode, 1) << to;
        EXPECT_THAT(json.err, HasSubstr("standard output: cannot be written")) << to;
    }
    EXPECT_EQ(jsonOf(folder / "out/report.json")["scan"]["file"], "../room.glb"); // nothing in it
}

// What a shelf of scans asks for: one command, a folder each, and what is broken stops nothing.
TEST_F(ResultProgram, SeveralScansGoIntoFoldersOfTheirNames)
{
    const Outcome run =
        inside(".", "cp room.glb hall.glb; head -c 5000 room.glb > broken.glb; "
                    "$RELAMP delight hall.glb broken.glb room.glb -o all --quality draft -q");

    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("broken.glb"));
    EXPECT_THAT(run.err, HasSubstr("2 of 3 scans are done"));
    for (const char* scan : {"hall", "room"})
        EXPECT_EQ(contentOf(folder / "all" / scan / "albedo.exr"),
                  contentOf(folder / "out" / "albedo.exr"));
    EXPECT_FALSE(fs::exists(folder / "all" / "broken"));
}

TEST_F(ResultProgram, CtrlCEndsAllScansThatAreToCome)
{
    std::vector<std::string> arguments{"delight", "-o", folder / "all", "-q", "--quality", "draft"};
    for (const char* name :
         {"1.glb", "2.glb", "3.glb", "4.glb", "5.glb", "6.glb", "7.glb", "8.glb"}) {
        fs::copy_file(folder / "room.glb", folder / name);
        arguments.push_back(folder / name);
    }

    EXPECT_EQ(runRelamp(arguments, 1.5).exitCode, 130);
    EXPECT_FALSE(fs::exists(folder / "all" / "8"));
}

// What a program that shows progress of its own reads, whatever else is said.
TEST_F(ResultProgram, ProgressIsToldByLinesOfStageAndPerCent)
{
    const Outcome run = delight({"--progress"}); // and -q
    ASSERT_EQ(run.exitCode, 0);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, testing::StartsWith("  read 0 %\n"));
    EXPECT_THAT(run.err, HasSubstr("\n  rays 0 %\n"));
    EXPECT_THAT(run.err, testing::EndsWith("  write 100 %\n"));
    std::istringstream lines(run.err);
    for (std::string line; std::getline(lines, line);)
        EXPECT_THAT(line, testing::ContainsRegex("^  [a-z ]+ [0-9]+ %$"));
}

TEST_F(ResultProgram, WhatIsAboutOneScanIsRefusedOfSeveral)
{
    const Outcome twins =
        inside(".", "mkdir a; cp room.glb a; $RELAMP delight room.glb a/room.glb -o all");
    EXPECT_EQ(twins.exitCode, 2);
    EXPECT_THAT(twins.err, HasSubstr("room.glb and a/room.glb would go into one folder"));

    const Outcome place =
        inside(".", "cp room.glb hall.glb; $RELAMP delight room.glb hall.glb -o all --white 1,1,1");
    EXPECT_EQ(place.exitCode, 2);
    EXPECT_THAT(place.err, HasSubstr("--white"));
    EXPECT_FALSE(fs::exists(folder / "all"));
}

TEST_F(ResultProgram, FilmsKeepAStrangersFrames)
{
    const std::string film = "$RELAMP relight out --turntable 2 --size 64x36 --fixture all=on -q "
                             "-o film ";
    ASSERT_EQ(inside(".", film).exitCode, 0);
    EXPECT_EQ(inside(".", film).exitCode, 0);
    append(folder / "film/frame_0002.png", "edited");
    const Outcome refused = inside(".", film);
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("frame_0002.png"));
    EXPECT_EQ(inside(".", film + "--force").exitCode, 0);
}

} // namespace relamp::golden
