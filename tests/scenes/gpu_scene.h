#pragma once

#include "gpu/commands.h"
#include "gpu/device.h"
#include "scan/texels.h"

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace relamp::scenes
{

/// Tests on a device, under the eyes of Vulkan's validation layer: one complaint fails a test. A
/// machine without any device fails, too; Mesa's lavapipe is one.
class GpuTest : public testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void TearDown() override;

    static const gpu::Device& device() { return *device_; }

private:
    static std::unique_ptr<gpu::Device> device_; // a suite's
    static size_t heard_;
};

/// Names of the stages that ran.
std::vector<std::string> ran(const std::vector<gpu::Timing>& timings);

inline glm::vec3 at(const RgbBlock& block, size_t i)
{
    return {block.r[i], block.g[i], block.b[i]};
}

} // namespace relamp::scenes
