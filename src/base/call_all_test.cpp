#include "base/call_all.h"

#include "base/parallel.h"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

TEST(CallAll, OneThatThrowsLeavesTheLoopsOfOthersAlone)
{
    std::atomic<size_t> count = 0;
    const auto counts = [&] {
        for (int round = 0; round < 200; ++round) forEach(1000, [&](size_t) { ++count; });
    };
    const auto throws = [&] { throw std::runtime_error("so"); };
    EXPECT_THROW(callAll(throws, counts, counts), std::runtime_error);
    EXPECT_EQ(count, 400'000u);
}

TEST(CallAll, AllAreCalled)
{
    std::atomic<int> sum = 0;
    callAll([&] { sum += 1; }, [&] { sum += 10; }, [&] { sum += 100; });
    EXPECT_EQ(sum, 111);
}

} // namespace
} // namespace relamp
