#include "resources.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <vector>

namespace
{

VkFormat formatOf(TexelFormat format)
{
    switch (format) {
    case TexelFormat::srgb8:
        return VK_FORMAT_R8G8B8A8_SRGB;
    case TexelFormat::rgb9e5:
        return VK_FORMAT_E5B9G9R9_UFLOAT_PACK32;
    case TexelFormat::grey8:
        return VK_FORMAT_R8_UNORM;
    }
    return VK_FORMAT_UNDEFINED;
}

VkImageCreateInfo sampledImage(const TexturePixels& pixels)
{
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = formatOf(pixels.format);
    info.extent = {pixels.levels[0].width, pixels.levels[0].height, 1};
    info.mipLevels = static_cast<uint32_t>(pixels.levels.size());
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return info;
}

} // namespace

void changeLayout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                  VkImageLayout from, VkImageLayout to)
{
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
}

Buffer::Buffer(const Device& device, size_t bytes, VkBufferUsageFlags usage) : bytes_(bytes)
{
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = std::max<size_t>(bytes, 4);
    info.usage = usage;
    VkBuffer made = nullptr;
    check(vkCreateBuffer(device.get(), &info, nullptr, &made), "making a buffer");
    buffer_ = {device.get(), made};
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.get(), made, &needs);
    memory_ = device.allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                         VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device.get(), made, memory_.get(), 0), "binding memory");
    void* at = nullptr;
    check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &at), "mapping memory");
    mapped_ = static_cast<std::byte*>(at);
}

void Buffer::write(std::span<const std::byte> bytes)
{
    assert(bytes.size() <= bytes_);
    if (!bytes.empty()) std::memcpy(mapped_, bytes.data(), bytes.size());
}

DeviceImage::DeviceImage(const Device& device, const VkImageCreateInfo& info,
                         VkImageAspectFlags aspect)
{
    VkImage made = nullptr;
    check(vkCreateImage(device.get(), &info, nullptr, &made), "making an image");
    image_ = {device.get(), made};
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.get(), made, &needs);
    memory_ = device.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device.get(), made, memory_.get(), 0), "binding memory");
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = made;
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = info.format;
    viewInfo.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
    VkImageView view = nullptr;
    check(vkCreateImageView(device.get(), &viewInfo, nullptr, &view), "making a view of an image");
    view_ = {device.get(), view};
}

DeviceImage uploaded(const Device& device, const TexturePixels& pixels)
{
    DeviceImage image(device, sampledImage(pixels), VK_IMAGE_ASPECT_COLOR_BIT);
    const Buffer staging(device, std::span<const std::byte>(pixels.bytes),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::vector<VkBufferImageCopy> copies;
    for (uint32_t level = 0; level < pixels.levels.size(); ++level) {
        VkBufferImageCopy copy{};
        copy.bufferOffset = pixels.levels[level].offset;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
        copy.imageExtent = {pixels.levels[level].width, pixels.levels[level].height, 1};
        copies.push_back(copy);
    }
    device.run([&](VkCommandBuffer commands) {
        changeLayout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        vkCmdCopyBufferToImage(commands, staging.get(), image.get(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               static_cast<uint32_t>(copies.size()), copies.data());
        changeLayout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT,
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    return image;
}
