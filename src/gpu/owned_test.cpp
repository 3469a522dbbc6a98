#include "gpu/owned.h"

#include "relamp/error.h"

#include <gmock/gmock.h>

namespace relamp::gpu
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<VkFence> destroyed;

VkFence fence(uintptr_t number)
{
    return reinterpret_cast<VkFence>(
        number); // NOLINT(performance-no-int-to-ptr): nobody looks there
}

void VKAPI_PTR destroy(VkDevice /*device*/, VkFence one, const VkAllocationCallbacks* /*memory*/)
{
    destroyed.push_back(one);
}

VkResult VKAPI_PTR refuse(VkDevice /*device*/, const VkFenceCreateInfo* /*info*/,
                          const VkAllocationCallbacks* /*memory*/, VkFence* /*made*/)
{
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

} // namespace

TEST(Owned, IsDestroyedOnceWhereverItWasMoved)
{
    destroyed.clear();
    {
        Owned<VkFence> first(nullptr, fence(1), destroy);
        Owned<VkFence> second(nullptr, fence(2), destroy);
        Owned<VkFence> moved(std::move(first));
        EXPECT_FALSE(first); // NOLINT(bugprone-use-after-move): what is left of it
        second = std::move(moved);
        EXPECT_THAT(destroyed, ElementsAre(fence(2)));
        EXPECT_EQ(second.get(), fence(1));
    }
    EXPECT_THAT(destroyed, ElementsAre(fence(2), fence(1)));
}

TEST(Owned, SaysWhatCouldNotBeMadeAndAWayOut)
{
    try {
        owned(VkDevice{}, refuse, destroy, VkFenceCreateInfo{}, "making a fence");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::device);
        EXPECT_THAT(error.what(), HasSubstr("making a fence: the device has not enough memory"));
        EXPECT_THAT(error.what(), HasSubstr("--engine cpu"));
    }
}

} // namespace relamp::gpu
