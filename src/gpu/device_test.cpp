#include "gpu/device.h"

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "relamp/error.h"
#include "scenes/gpu_scene.h"

#include <gmock/gmock.h>

namespace relamp::gpu
{
namespace
{

using ::testing::HasSubstr;

class Gpu : public scenes::GpuTest
{};

} // namespace

TEST_F(Gpu, GivesBackWhatItWasGiven)
{
    std::vector<uint32_t> values(5'000'000); // more than goes over at once
    for (uint32_t i = 0; i < values.size(); ++i) values[i] = 7 * i;
    const Array<uint32_t> array(device(), values);
    EXPECT_EQ(array.download(), values);
}

TEST_F(Gpu, ClearsAndCopiesInTheOrderOfBarriers)
{
    const std::vector<uint32_t> ones(1000, 1);
    const Array<uint32_t> from(device(), ones);
    const Array<uint32_t> to(device(), ones);
    Commands commands(device());
    commands.mark("clear");
    commands.clear(from.buffer());
    commands.barrier();
    commands.mark("copy");
    commands.copy(from.buffer(), 0, to.buffer(), 0, from.buffer().size());
    commands.run();
    EXPECT_EQ(to.download(), std::vector<uint32_t>(1000, 0));
    const std::vector<Timing> timings = commands.timings();
    ASSERT_EQ(timings.size(), 2u);
    EXPECT_EQ(timings[0].name, "clear");
    for (const Timing& timing : timings) {
        EXPECT_GT(timing.seconds, 0.0);
        EXPECT_LT(timing.seconds, 1.0);
    }
}

TEST_F(Gpu, SaysWhatToDoWhereTheWorldIsNotAsAskedFor)
{
    try {
        const Device none("no such device");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::device);
        EXPECT_THAT(error.what(), HasSubstr("\"no such device\""));
        EXPECT_THAT(error.what(), HasSubstr("--engine cpu"));
    }
    try {
        const Buffer tooLarge(device(), size_t{1} << 50);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::device);
        EXPECT_THAT(error.what(), HasSubstr("MB"));
    }
}

TEST_F(Gpu, IsChosenByIndexAndByAPartOfItsName)
{
    const std::string name = gpuDevices().at(0).name;
    EXPECT_EQ(Device("0").description().name, name);
    EXPECT_EQ(Device(name.substr(1, 4)).description().name, name);
}

} // namespace relamp::gpu
