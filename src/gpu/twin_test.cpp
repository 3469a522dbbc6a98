#include "gpu/twin.h"

#include "scenes/gpu_scene.h"

#include <gmock/gmock.h>

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

TEST_F(GpuTwin, WhatIsNoFaultOfTheDeviceIsNoReasonToHandOver)
{
    Twin<Stages> stages = twin(true);
    EXPECT_THROW(stages.compute([](Stages&) { fail(ErrorCode::cancelled); }), Error);
    EXPECT_NE(stages.name(), "cpu");
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
