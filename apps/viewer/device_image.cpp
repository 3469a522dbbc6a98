#include "device_image.h"

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/memory.h"

#include <cstring>
#include <vector>

namespace gpu = relamp::gpu;

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

DeviceImage::DeviceImage(const gpu::Device& device, const VkImageCreateInfo& info,
                         VkImageAspectFlags aspect)
{
    constexpr const char* kWhat = "making an image";
    image_ = gpu::owned(device.handle(), vkCreateImage, vkDestroyImage, info, kWhat);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle(), get(), &needs);
    memory_ = gpu::allocate(device, needs, gpu::Place::device, kWhat);
    gpu::check(vkBindImageMemory(device.handle(), get(), memory_.get(), 0), kWhat);
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = get();
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = info.format;
    view.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
    view_ = gpu::owned(device.handle(), vkCreateImageView, vkDestroyImageView, view, kWhat);
}

DeviceImage uploaded(const gpu::Device& device, const TexturePixels& pixels)
{
    DeviceImage image(device, sampledImage(pixels), VK_IMAGE_ASPECT_COLOR_BIT);
    const gpu::Buffer staging(device, pixels.bytes.size(), gpu::Place::host,
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.bytes().data(), pixels.bytes.data(), pixels.bytes.size());
    std::vector<VkBufferImageCopy> copies;
    for (uint32_t level = 0; level < pixels.levels.size(); ++level) {
        VkBufferImageCopy copy{};
        copy.bufferOffset = pixels.levels[level].offset;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
        copy.imageExtent = {pixels.levels[level].width, pixels.levels[level].height, 1};
        copies.push_back(copy);
    }
    gpu::Commands commands(device);
    changeLayout(commands.handle(), image.get(), VK_IMAGE_ASPECT_COLOR_BIT,
                 VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(commands.handle(), staging.handle(), image.get(),
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<uint32_t>(copies.size()), copies.data());
    changeLayout(commands.handle(), image.get(), VK_IMAGE_ASPECT_COLOR_BIT,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.run();
    return image;
}
