#pragma once

#include "gpu/vulkan.h"
#include "relamp/api.h"

#include <string_view>

namespace relamp::gpu
{

/// Throws Error(device) with a sentence where `result` is a failure. `what` is what was tried, as
/// in "reserving memory".
RELAMP_API void check(VkResult result, std::string_view what);

} // namespace relamp::gpu
