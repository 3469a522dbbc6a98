#include "gpu/check.h"

#include "relamp/error.h"

#include <fmt/format.h>

namespace relamp::gpu
{
namespace
{

std::string reasonOf(VkResult result)
{
    switch (result) {
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost: its driver was restarted, or it took too long";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "the device has not enough memory left; smaller textures take less";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "this machine has not enough memory left";
    default:
        return fmt::format("the driver refused ({})", static_cast<int>(result));
    }
}

} // namespace

void check(VkResult result, std::string_view what)
{
    if (result >= 0) return;
    // In the viewer, too, which draws on the device all the same.
    throw Error(ErrorCode::device, fmt::format("GPU, {}: {}; --engine cpu computes without it",
                                               what, reasonOf(result)));
}

} // namespace relamp::gpu
