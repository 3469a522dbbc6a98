#include "relamp/threads.h"

#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace relamp
{

// A loop that others helped with would run some of its steps on threads of theirs.
TEST(Threads, OfALimitOfOneIsTheCallerAlone)
{
    const ThreadLimit one(1);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    forEachChunk(50, 1, [&](size_t, size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that there is time to help
        if (std::this_thread::get_id() != caller) ++elsewhere;
    });
    EXPECT_EQ(elsewhere, 0);
}

} // namespace relamp
