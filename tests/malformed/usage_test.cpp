// What a person types wrong.

#include "malformed/run_in_folder.h"

#include <gmock/gmock.h>

namespace relamp::malformed
{
namespace
{

using testing::HasSubstr;

class Usage : public RunInFolder
{
protected:
    void SetUp() override { write(smallTextPly()); }

    /// Ends with 2, says `words` and where there is help, and does nothing else.
    void expectUsageError(const std::vector<std::string>& arguments, const std::string& words) const
    {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const golden::Outcome run = golden::runRelamp(arguments);
        EXPECT_EQ(run.exitCode, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_THAT(run.err, HasSubstr("--help"));
        EXPECT_THAT(names(), testing::ElementsAre("room.ply"));
    }

    void expectUsageError(const std::string& option, const std::vector<std::string>& values) const
    {
        for (const std::string& value : values)
            expectUsageError({"delight", folder / "room.ply", "-o", folder / "out", option, value},
                             option);
    }
};

} // namespace

TEST_F(Usage, WhatIsNotKnownIsNamed)
{
    expectUsageError({"delight", folder / "room.ply", "-o", folder / "out", "--brighter"},
                     "--brighter");
    expectUsageError({"delight", folder / "room.ply", "more", "-o", folder / "out"}, "more");
    expectUsageError({"paint", folder / "room.ply"}, "paint");
    expectUsageError("--solver", {"bogus", ""});
    expectUsageError("--up", {"x", "up", "0"});
    expectUsageError({"delight", folder / "room.ply", "-o", folder / "out", "--quality", "best"},
                     "\"best\" is none of draft, high, standard");
    expectUsageError("--transfer", {"gamma"});
}

TEST_F(Usage, WhatIsMissingIsNamed)
{
    expectUsageError({"help", "paint"}, "paint");
    expectUsageError({"delight"}, "scan");
    expectUsageError({"delight", folder / "room.ply"}, "--output");
    expectUsageError({"delight", folder / "room.ply", "-o"}, "--output");
    expectUsageError({"info"}, "scan");
    expectUsageError({"delight", folder / "room.ply", "-o", folder / "out", "--attenuation", "1"},
                     "--attenuation");
}

TEST_F(Usage, PlacesAreThreeNumbers)
{
    expectUsageError("--light", {"1,2", "1,2,x", "1,2,3,4", "nan,0,0", "1e9,0,0", ",,"});
    expectUsageError("--white", {"here", "1;2;3"});
    expectUsageError("--same", {"1,2,3", "1,2,3:4,5", "1,2,3:4,5,6:7,8,9", "1,2,3,4,5,6"});
    expectUsageError({"delight", folder / "room.ply", "-o", folder / "out", "--same", "1,2,3"},
                     "\"1,2,3\" is not X,Y,Z:X,Y,Z");
}

// Nothing is estimated there, and what was said would be lost without a word.
TEST_F(Usage, WhatIsSaidOfTheSearchDoesNotGoWithLightsThatAreGiven)
{
    for (const std::vector<std::string>& said :
         std::vector<std::vector<std::string>>{{"--white", "1,2,3"},
                                               {"--same", "1,2,3:4,5,6"},
                                               {"--light", "1,2,3"},
                                               {"--not-a-light", "1,2,3"},
                                               {"--response", "straight"},
                                               {"--no-gain"},
                                               {"--no-sun"}}) {
        std::vector<std::string> line{"delight",      folder / "room.ply", "-o",
                                      folder / "out", "--lights",          "lights.json"};
        line.insert(line.end(), said.begin(), said.end());
        expectUsageError(line, "nothing is estimated where the lights are given, so that " +
                                   said[0] + " would change nothing");
    }
}

TEST_F(Usage, OptionsOfAnotherSolverAreRefused)
{
    const std::vector<std::vector<std::string>> lines{{"thesis", "--same", "1,2,3:4,5,6"},
                                                      {"thesis", "--white", "1,2,3"},
                                                      {"thesis", "--response", "straight"},
                                                      {"thesis", "--no-gain"},
                                                      {"thesis", "--seed", "2"},
                                                      {"thesis", "--samples", "4"},
                                                      {"gather", "--samples", "4"},
                                                      {"gather", "--no-lpv"},
                                                      {"pathtrace", "--power", "2"}};
    for (const std::vector<std::string>& said : lines) {
        std::vector<std::string> line{"delight", folder / "room.ply", "-o", folder / "out",
                                      "--solver"};
        line.insert(line.end(), said.begin(), said.end());
        expectUsageError(line, "the " + said[0] + " solver has no use for it");
    }
}

// A script whose variable is empty must not delight a scan without the lights that it meant.
TEST_F(Usage, EmptyNamesAreNoNames)
{
    const std::string scan = folder / "room.ply";
    const std::string out = folder / "out";
    for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{
             {"delight", scan, "-o", ""},
             {"delight", scan, "-o", out, "--lights", ""},
             {"delight", "", "-o", out},
             {"info", ""},
             {"verify", ""},
             {"verify", folder.path(), "--scan", ""},
             {"relight", scan, "-o", ""},
             {"relight", scan, "-o", out + ".png", "--camera", ""},
             {"relight", scan, "-o", out, "--timeline", ""},
             {"relight", scan, "-o", out + ".png", "--albedo", ""}})
        expectUsageError(line, "is empty");
    expectUsageError({"delight", scan, "-o", out, "--lights="}, "--lights");
}

TEST_F(Usage, ValuesOutOfRangeAreNamed)
{
    expectUsageError("--scale", {"nan", "inf", "0", "x", ""});
    expectUsageError("--threads", {"-1", "1e9", "1.5"});
    expectUsageError("--darkest", {"nan", "0"});
    expectUsageError("--expansion", {"0.5"});
    expectUsageError("--light-levels", {"11", "99999999999999999999"});
    expectUsageError("--power", {"-1"});
    expectUsageError("--lpv-size", {"7", "129"});
}

} // namespace relamp::malformed
