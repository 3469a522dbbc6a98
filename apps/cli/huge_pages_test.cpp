#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace
{

/// What the kernel knows about the memory at an address of this process.
std::string flagsOfMemoryAt(const void* address)
{
    std::ifstream maps("/proc/self/smaps");
    std::string line;
    bool isThere = false;
    while (std::getline(maps, line)) {
        unsigned long begin = 0;
        unsigned long end = 0;
        if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2)
            isThere = reinterpret_cast<uintptr_t>(address) - begin < end - begin;
        if (isThere && line.starts_with("VmFlags:")) return line + ' ';
    }
    return "";
}

} // namespace

TEST(HugePages, AreAskedForWhereAnArrayIsLarge)
{
    struct alignas(64) Line
    {
        char bytes[64] = {1};
    };
    const std::vector<char> large(size_t{64} << 20, 1);
    const std::vector<Line> lines(size_t{1} << 20);
    const std::string flags = flagsOfMemoryAt(&large[large.size() / 2]);
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage") || flags.empty())
        GTEST_SKIP() << "this kernel has none";
    EXPECT_THAT(flags, testing::HasSubstr(" hg "));
    EXPECT_THAT(flagsOfMemoryAt(&lines[lines.size() / 2]), testing::HasSubstr(" hg "));
}

TEST(HugePages, MoreMemoryThanThereIsIsRefusedAsEver)
{
    volatile size_t tooMuch = size_t{1} << 60;
    EXPECT_THROW(operator delete(operator new(tooMuch)), std::bad_alloc);
    constexpr std::align_val_t kAlignment{64};
    EXPECT_THROW(operator delete(operator new(tooMuch, kAlignment), kAlignment), std::bad_alloc);
}
