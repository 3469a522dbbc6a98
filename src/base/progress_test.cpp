#include "relamp/progress.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

void rest()
{
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

} // namespace

// A clock that two stages share would make them add up to more than there was.
TEST(Progress, StagesWithinOthersAddUpToTheTimeThatPassed)
{
    Progress progress;
    {
        const Progress::Stage read(progress, "read");
        rest();
        {
            const Progress::Stage pages(progress, "read");
            rest();
            const Progress::Stage decode(progress, "decode");
            rest();
        }
        rest();
    }
    const auto times = progress.times();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].stage, "decode");
    EXPECT_GE(times[0].seconds, 0.010);
    EXPECT_GE(times[1].seconds, 0.030);
    EXPECT_LE(times[0].seconds + times[1].seconds, progress.elapsed());
}

} // namespace relamp
