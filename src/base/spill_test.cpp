#include "base/spill.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relamp
{
namespace
{

constexpr size_t kValues = size_t{12} << 20; // 48 MB

std::vector<uint32_t> someValues()
{
    std::vector<uint32_t> values(kValues);
    std::iota(values.begin(), values.end(), 7u);
    return values;
}

/// MB of this process that are in RAM and in no file, and in RAM and of a file.
struct InRam
{
    size_t anonymous = 0;
    size_t ofFiles = 0;
};

InRam inRam()
{
    InRam ram;
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        size_t kilobytes = 0;
        if (word == "RssAnon:" && status >> kilobytes) ram.anonymous = kilobytes / 1024;
        if (word == "RssFile:" && status >> kilobytes) ram.ofFiles = kilobytes / 1024;
    }
    return ram;
}

uint64_t sumOf(const std::vector<uint32_t>& values)
{
    return std::accumulate(values.begin(), values.end(), uint64_t{0});
}

TEST(Spill, HoldsWhatItHeld)
{
    std::vector<uint32_t> values = someValues();
    ASSERT_TRUE(spill(values));
    EXPECT_EQ(values, someValues());
    letGo(values);
    EXPECT_EQ(values, someValues());
    values[kValues / 2] = 3;
    ASSERT_TRUE(spill(values)); // as they are now
    letGo(values);
    EXPECT_EQ(values[kValues / 2], 3u);
}

TEST(Spill, LeavesRam)
{
    std::vector<uint32_t> values = someValues();
    const size_t before = inRam().anonymous;
    ASSERT_TRUE(spill(values));
    EXPECT_LT(inRam().anonymous + 40, before);
    const size_t untouched = inRam().ofFiles;
    const uint64_t sum = sumOf(values);
    EXPECT_GT(inRam().ofFiles, untouched + 40);
    letGo(values);
    EXPECT_LT(inRam().ofFiles, untouched + 8);
    EXPECT_EQ(sumOf(values), sum);
}

TEST(Spill, StaysWhereItIsWithoutRoom)
{
    const char* before = std::getenv("TMPDIR");
    const std::string folder = before != nullptr ? before : "";
    setenv("TMPDIR", "/nowhere/at/all", 1);
    std::vector<uint32_t> values = someValues();
    EXPECT_FALSE(spill(values));
    before != nullptr ? setenv("TMPDIR", folder.c_str(), 1) : unsetenv("TMPDIR");
    EXPECT_EQ(values, someValues());
}

// The C library keeps blocks of some megabytes together, once one of them was freed: what lies in
// freed ones next must not be shared with a copy of the process, as their file was.
TEST(Spill, LeavesNothingSharedBehind)
{
    constexpr size_t kSome = size_t{4} << 20; // bytes
    std::vector<uint8_t>(2 * kSome, 1);
    std::vector<uint8_t> spilled(kSome, 1);
    ASSERT_TRUE(spill(spilled));
    EXPECT_EQ(spilled, std::vector<uint8_t>(kSome, 1));
    std::vector<uint8_t>().swap(spilled);
    std::vector<uint8_t> next(kSome, 2);
    const pid_t copy = fork();
    if (copy == 0) {
        std::fill(next.begin(), next.end(), uint8_t{3});
        _exit(0);
    }
    ASSERT_EQ(waitpid(copy, nullptr, 0), copy);
    EXPECT_EQ(next, std::vector<uint8_t>(kSome, 2));
}

TEST(Spill, ACopyIsInNoFile)
{
    InFile isInFile;
    isInFile = true;
    InFile copy(isInFile);
    EXPECT_TRUE(isInFile);
    EXPECT_FALSE(copy);
    copy = std::move(isInFile);
    EXPECT_TRUE(copy);
    EXPECT_FALSE(isInFile);
}

TEST(Spill, LeavesSmallThingsAlone)
{
    std::vector<uint32_t> values(100, 1);
    EXPECT_FALSE(spill(values));
    EXPECT_EQ(values, std::vector<uint32_t>(100, 1));
}

} // namespace
} // namespace relamp
