#include "target.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace
{

constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;

OwnedRenderPass renderPass(const Device& device, VkFormat colour)
{
    std::array<VkAttachmentDescription, 2> attachments{};
    attachments[0].format = colour;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    attachments[1].format = kDepth;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    for (VkAttachmentDescription& attachment : attachments) {
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    }
    const VkAttachmentReference colourAt{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depthAt{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colourAt;
    subpass.pDepthStencilAttachment = &depthAt;
    // The frame before may still be copied from; the copy of this one comes after it was drawn.
    std::array<VkSubpassDependency, 2> dependencies{};
    dependencies[0] = {VK_SUBPASS_EXTERNAL,
                       0,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT,
                       VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                       VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                       0};
    dependencies[1] = {0,
                       VK_SUBPASS_EXTERNAL,
                       VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT,
                       VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_ACCESS_MEMORY_WRITE_BIT,
                       VK_ACCESS_TRANSFER_READ_BIT,
                       0};
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    VkRenderPass made = nullptr;
    check(vkCreateRenderPass(device.get(), &info, nullptr, &made), "making a render pass");
    return {device.get(), made};
}

DeviceImage attachment(const Device& device, VkFormat format, VkExtent2D size,
                       VkImageUsageFlags usage, VkImageAspectFlags aspect)
{
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    return {device, info, aspect};
}

} // namespace

Target::Target(const Device& device, VkFormat colour, uint32_t width, uint32_t height)
    : device_(device), format_(colour), pass_(renderPass(device, colour))
{
    resize(width, height);
}

void Target::resize(uint32_t width, uint32_t height)
{
    size_ = {std::max(width, 1u), std::max(height, 1u)};
    framebuffer_ = {};
    colour_ = attachment(device_, format_, size_, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                         VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ = attachment(device_, kDepth, size_, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                        VK_IMAGE_ASPECT_DEPTH_BIT);
    const std::array<VkImageView, 2> views{colour_.view(), depth_.view()};
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pass_.get();
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size_.width;
    info.height = size_.height;
    info.layers = 1;
    VkFramebuffer made = nullptr;
    check(vkCreateFramebuffer(device_.get(), &info, nullptr, &made), "making a framebuffer");
    framebuffer_ = {device_.get(), made};
}

void Target::begin(VkCommandBuffer commands, const std::array<float, 4>& clear) const
{
    std::array<VkClearValue, 2> values{};
    std::memcpy(values[0].color.float32, clear.data(), sizeof(clear));
    values[1].depthStencil.depth = 1.0f;
    VkRenderPassBeginInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    info.renderPass = pass_.get();
    info.framebuffer = framebuffer_.get();
    info.renderArea.extent = size_;
    info.clearValueCount = static_cast<uint32_t>(values.size());
    info.pClearValues = values.data();
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

std::vector<std::byte> Target::pixels(size_t bytesAPixel) const
{
    const Buffer read(device_, bytesAPixel * size_.width * size_.height,
                      VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    device_.run([&](VkCommandBuffer commands) {
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {size_.width, size_.height, 1};
        vkCmdCopyImageToBuffer(commands, colour_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               read.get(), 1, &copy);
    });
    return {read.mapped(), read.mapped() + read.bytes()};
}

float Target::depthAt(uint32_t x, uint32_t y) const
{
    if (x >= size_.width || y >= size_.height) return 1.0f;
    const Buffer read(device_, sizeof(float), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    device_.run([&](VkCommandBuffer commands) {
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
        copy.imageOffset = {static_cast<int32_t>(x), static_cast<int32_t>(y), 0};
        copy.imageExtent = {1, 1, 1};
        vkCmdCopyImageToBuffer(commands, depth_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               read.get(), 1, &copy);
    });
    float depth = 1.0f;
    std::memcpy(&depth, read.mapped(), sizeof(depth));
    return depth;
}
