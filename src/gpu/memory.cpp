#include "gpu/memory.h"

#include <optional>

namespace relamp::gpu
{
namespace
{

/// The first type of memory that has all `flags` and is among `allowed`.
std::optional<uint32_t> memoryType(const Device& device, uint32_t allowed,
                                   VkMemoryPropertyFlags flags)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device.physical(), &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    return std::nullopt;
}

uint32_t memoryTypeFor(const Device& device, uint32_t allowed, Place place)
{
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (place == Place::device)
        return memoryType(device, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT).value_or(0);
    if (const auto cached =
            memoryType(device, allowed, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT))
        return *cached; // reading back from what is not cached takes ten times as long
    return memoryType(device, allowed, kMapped).value_or(0);
}

} // namespace

Owned<VkDeviceMemory> allocate(const Device& device, const VkMemoryRequirements& needs, Place place,
                               std::string_view what, VkMemoryAllocateFlags flags)
{
    VkMemoryAllocateFlagsInfo more{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    more.flags = flags;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &more};
    info.allocationSize = needs.size;
    info.memoryTypeIndex = memoryTypeFor(device, needs.memoryTypeBits, place);
    return owned(device.handle(), vkAllocateMemory, vkFreeMemory, info, what);
}

} // namespace relamp::gpu
