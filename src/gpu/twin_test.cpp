#include "gpu/twin.h"

#include "base/parallel.h"
#include "scenes/gpu_scene.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace relamp::gpu
{
namespace
{

using ::testing::HasSubstr;

/// Stages that know whether their device is still there.
struct Stages
{
    explicit Stages(const Device& of) : device(of) {}
    ~Stages() { EXPECT_NE(device.handle(), VK_NULL_HANDLE); }

    const Device& device;
    int calls = 0;
};

/// On whatever device there is, as if nobody or somebody had asked for it.
Twin<Stages> twin(bool isFree)
{
    return {{.device = std::make_unique<Device>(), .isFree = isFree},
            [](const Device& device) { return std::make_unique<Stages>(device); }};
}

[[noreturn]] void fail(ErrorCode code)
{
    throw Error(code, "GPU: the device was lost");
}

} // namespace

using GpuTwin = scenes::GpuTest;

TEST_F(GpuTwin, ComputesWithTheSameStagesAgainAndAgain)
{
    Twin<Stages> stages = twin(true);
    EXPECT_EQ(stages.name(), device().description().name);
    EXPECT_TRUE(stages.compute([](Stages& s) { EXPECT_EQ(++s.calls, 1); }));
    EXPECT_TRUE(stages.compute([](Stages& s) { EXPECT_EQ(++s.calls, 2); }));
    EXPECT_EQ(stages.note(), "");
}

TEST_F(GpuTwin, HandsOverWhereNobodyAskedForIt)
{
    Twin<Stages> stages = twin(true);
    EXPECT_FALSE(stages.compute([](Stages&) { fail(ErrorCode::device); }));
    EXPECT_EQ(stages.name(), "cpu");
    EXPECT_EQ(stages.note(), "GPU: the device was lost; the CPU took over");
    EXPECT_FALSE(stages.compute([](Stages&) { ADD_FAILURE() << "it is gone for good"; }));
}

TEST_F(GpuTwin, HandsOverWhereItsStagesHaveNoRoom)
{
    Twin<Stages> stages({.device = std::make_unique<Device>()},
                        [](const Device&) -> std::unique_ptr<Stages> { fail(ErrorCode::device); });
    EXPECT_FALSE(stages.compute([](Stages&) { ADD_FAILURE(); }));
    EXPECT_EQ(stages.name(), "cpu");
}

TEST_F(GpuTwin, FailsWhereSomebodyDid)
{
    Twin<Stages> stages = twin(false);
    EXPECT_THROW(stages.compute([](Stages&) { fail(ErrorCode::device); }), Error);
    EXPECT_NE(stages.name(), "cpu");
    EXPECT_TRUE(stages.compute([](Stages&) {})); // it is for the person to decide
}

// Work that ended half-way leaves behind what later work would take for done.
TEST_F(GpuTwin, MakesStagesAnewAfterWorkThatFailed)
{
    Twin<Stages> stages = twin(false);
    const auto failing = [](Stages& s) {
        ++s.calls;
        fail(ErrorCode::device);
    };
    EXPECT_THROW(stages.compute(failing), Error);
    EXPECT_TRUE(stages.compute([](Stages& s) { EXPECT_EQ(++s.calls, 1); }));
}

TEST_F(GpuTwin, WhatIsNoFaultOfTheDeviceIsNoReasonToHandOver)
{
    Twin<Stages> stages = twin(true);
    EXPECT_THROW(stages.compute([](Stages&) { fail(ErrorCode::cancelled); }), Error);
    EXPECT_NE(stages.name(), "cpu");
}

// In a loop whose chunks take turns, as blocks of texels do: a second one on the same thread would
// wait for the lock that it holds.
TEST_F(GpuTwin, WhoWaitsForItsLoopsTakesUpNoChunkOfALoopAround)
{
    constexpr int kThreads = 8;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
    Twin<Stages> stages = twin(true);
    std::mutex mutex;
    std::atomic<int> secondChunks = 0;
    tbb::task_arena(kThreads).execute([&] {
        forEachChunk(600, 1, [&](size_t, size_t) {
            static thread_local bool holdsLock = false;
            if (holdsLock) {
                ++secondChunks;
                return;
            }
            const std::lock_guard lock(mutex);
            holdsLock = true;
            stages.compute([](Stages&) {
                forEachChunk(8, 1, [](size_t, size_t) {
                    std::this_thread::sleep_for(std::chrono::microseconds(20));
                });
            });
            holdsLock = false;
        });
    });
    EXPECT_EQ(secondChunks, 0);
}

TEST_F(GpuTwin, ASoftwareDeviceIsChosenOnlyWhereItIsAskedFor)
{
    EXPECT_EQ(Choice::of({}).device != nullptr, device().description().isReal());
    EXPECT_EQ(Choice::of({.engine = Engine::cpu}).device, nullptr);
    EXPECT_FALSE(Choice::of({.engine = Engine::gpu}).isFree);
    EXPECT_NE(Choice::of({.gpu = "0"}).device, nullptr);
    EXPECT_THROW(static_cast<void>(Choice::of({.engine = Engine::gpu, .gpu = "none such"})), Error);
}

} // namespace relamp::gpu
