#pragma once

#include "gpu/device.h"
#include "gpu/owned.h"
#include "gpu/vulkan.h"
#include "relamp/api.h"

#include <string_view>

namespace relamp::gpu
{

/// Where memory lies.
enum class Place {
    device, // where the device reaches it fastest
    host    // where this program reaches it, too
};

/// Memory for a buffer or an image that has these `needs`. Throws Error(device), saying `what` was
/// tried, where there is no room for it.
RELAMP_API Owned<VkDeviceMemory> allocate(const Device& device, const VkMemoryRequirements& needs,
                                          Place place, std::string_view what,
                                          VkMemoryAllocateFlags flags = 0);

} // namespace relamp::gpu
