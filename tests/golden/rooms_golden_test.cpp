// The real program in eight small furnished rooms of known albedo and lamps, and one without lamps.

#include "golden/program.h"
#include "golden/score.h"
#include "scenes/temporary_folder.h"

#include <cstdio>
#include <ostream>

#include <gtest/gtest.h>

namespace relamp::golden
{
namespace
{

/// What the program makes of a room. docs/dev/rooms.md says how to write the table anew.
struct RoomFigures
{
    const char* room;
    double psnr; // dB
    double leakSlope;
    LampCount lamps;
};

constexpr RoomFigures kFigures[] = {
    {"study", 34.02, 0.020, {3, 0}},     {"bedroom", 32.21, -0.002, {3, 0}},
    {"corridor", 31.67, -0.001, {3, 0}}, {"classroom", 32.39, 0.006, {8, 0}},
    {"lounge", 32.58, 0.007, {6, 0}},    {"workshop", 31.11, 0.024, {3, 0}},
    {"open_plan", 32.48, 0.017, {5, 0}}, {"bathroom", 28.39, -0.020, {3, 0}},
    {"no_lamp", 31.68, 0.017, {0, 0}},
};

constexpr double kPsnrOff = 0.5; // dB that a figure may be off
constexpr double kLeakOff = 0.02;

void PrintTo(const RoomFigures& figures, std::ostream* stream)
{
    *stream << figures.room;
}

class RoomsProgram : public testing::TestWithParam<RoomFigures>
{};

INSTANTIATE_TEST_SUITE_P(, RoomsProgram, testing::ValuesIn(kFigures),
                         [](const auto& figures) { return std::string(figures.param.room); });

} // namespace

TEST_P(RoomsProgram, TakesTheLightOut)
{
    const RoomFigures& wanted = GetParam();
    const std::filesystem::path room = std::filesystem::path(RELAMP_ROOMS) / wanted.room;
    const scenes::TemporaryFolder folder;
    const Outcome run = runRelamp({"delight", room / "scan.glb", "-o", folder / "out", "-q"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    std::vector<std::string> warnings;
    const LampCount lamps = countLamps(readLights(folder / "out/lights.json", warnings), room);
    const Score score = scoreAlbedo(readPicture(folder / "out/albedo.exr"), truthOfSmallRoom(room));
    std::printf("    {\"%s\", %.2f, %.3f, {%d, %d}},\n", wanted.room, score.psnr, score.leakSlope,
                lamps.found, lamps.notLamps);
    EXPECT_NEAR(score.psnr, wanted.psnr, kPsnrOff);
    EXPECT_NEAR(score.leakSlope, wanted.leakSlope, kLeakOff);
    EXPECT_EQ(lamps.found, wanted.lamps.found);
    EXPECT_EQ(lamps.notLamps, wanted.lamps.notLamps);
}

} // namespace relamp::golden
