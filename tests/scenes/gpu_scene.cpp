#include "scenes/gpu_scene.h"

namespace relamp::scenes
{

std::unique_ptr<gpu::Device> GpuTest::device_;
size_t GpuTest::heard_ = 0;

void GpuTest::SetUpTestSuite()
{
    device_ = std::make_unique<gpu::Device>("", gpu::Validation::on);
    heard_ = 0;
}

void GpuTest::TearDownTestSuite()
{
    device_.reset();
}

void GpuTest::TearDown()
{
    const std::vector<std::string>& complaints = device_->instance().complaints();
    for (; heard_ < complaints.size(); ++heard_) ADD_FAILURE() << complaints[heard_];
}

std::vector<std::string> ran(const std::vector<gpu::Timing>& timings)
{
    std::vector<std::string> names;
    for (const gpu::Timing& timing : timings) names.push_back(timing.name);
    return names;
}

} // namespace relamp::scenes
