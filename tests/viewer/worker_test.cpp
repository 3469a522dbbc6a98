#include "worker.h"

#include "relamp/error.h"

#include <atomic>
#include <chrono>

#include <gmock/gmock.h>

namespace
{

using namespace std::chrono_literals;

void waitUntil(const std::function<bool()>& holds)
{
    for (int i = 0; i < 2000 && !holds(); ++i) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(holds());
}

TEST(Worker, TheNewestJobEndsWhatRuns)
{
    std::atomic<bool> ended = false;
    std::atomic<bool> done = false;
    Worker worker([] {}, [](const std::string&) {});
    std::atomic<bool> runs = false;
    worker.start([&](relamp::Progress& progress) {
        runs = true;
        try {
            while (true) {
                progress.check();
                std::this_thread::sleep_for(1ms);
            }
        } catch (const relamp::Error&) {
            ended = true;
            throw;
        }
    });
    waitUntil([&] { return runs.load(); });

    worker.start([&](relamp::Progress&) { done = true; });

    waitUntil([&] { return done && !worker.status().isBusy; });
    EXPECT_TRUE(ended);
}

TEST(Worker, TellsWhatFailedAndGoesOn)
{
    std::atomic<int> failures = 0;
    std::atomic<bool> done = false;
    Worker worker([] {}, [&](const std::string&) { ++failures; });
    worker.start([](relamp::Progress&) { throw std::runtime_error("it broke"); });
    waitUntil([&] { return failures == 1; });
    worker.start([&](relamp::Progress&) { done = true; });
    waitUntil([&] { return done.load(); });
}

} // namespace
