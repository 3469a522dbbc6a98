#include "target.h"

#include "gpu/buffer.h"
#include "gpu/commands.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace gpu = relamp::gpu;

namespace
{

// What a render pass draws into. Where pixels have several samples, they are drawn into images of
// their own, and these get what is left of them.
enum Attachment : uint32_t { kColour, kDepth, kColourSamples, kDepthSamples };

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

bool isDepth(Attachment attachment)
{
    return attachment == kDepth || attachment == kDepthSamples;
}

VkAttachmentDescription2 description(Attachment attachment, VkFormat colour,
                                     VkSampleCountFlagBits samples)
{
    const bool isKept = attachment == kColour || attachment == kDepth;
    const bool isDrawnInto = !isKept || samples == VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentDescription2 made{VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2};
    made.format = isDepth(attachment) ? kDepthFormat : colour;
    made.samples = isKept ? VK_SAMPLE_COUNT_1_BIT : samples;
    made.loadOp = isDrawnInto ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    made.storeOp = isKept ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    made.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    made.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    made.finalLayout = isKept                ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
                       : isDepth(attachment) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                             : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return made;
}

VkAttachmentReference2 reference(Attachment attachment)
{
    VkAttachmentReference2 to{VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2};
    to.attachment = attachment;
    to.layout = isDepth(attachment) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                    : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    to.aspectMask = isDepth(attachment) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    return to;
}

/// The frame before may still be copied from; the copy of this one comes after it was drawn.
std::array<VkSubpassDependency2, 2> dependencies()
{
    std::array<VkSubpassDependency2, 2> both{};
    for (VkSubpassDependency2& dependency : both)
        dependency.sType = VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2;
    both[0].srcSubpass = VK_SUBPASS_EXTERNAL;
    both[0].srcStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    both[0].dstStageMask = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
    both[0].srcAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    both[0].dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    both[1].dstSubpass = VK_SUBPASS_EXTERNAL;
    both[1].srcStageMask = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
    both[1].dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
    both[1].srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    both[1].dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    return both;
}

gpu::Owned<VkRenderPass> renderPass(const WindowDevice& device, VkFormat colour)
{
    const VkSampleCountFlagBits samples = device.samples();
    const bool resolves = samples != VK_SAMPLE_COUNT_1_BIT;
    const std::array<VkAttachmentDescription2, 4> attachments{
        description(kColour, colour, samples), description(kDepth, colour, samples),
        description(kColourSamples, colour, samples), description(kDepthSamples, colour, samples)};
    const VkAttachmentReference2 colourAt = reference(kColour);
    const VkAttachmentReference2 depthAt = reference(kDepth);
    const VkAttachmentReference2 colourSamples = reference(kColourSamples);
    const VkAttachmentReference2 depthSamples = reference(kDepthSamples);
    VkSubpassDescriptionDepthStencilResolve depthResolve{
        VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE};
    depthResolve.depthResolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT; // all devices can
    depthResolve.pDepthStencilResolveAttachment = &depthAt;
    VkSubpassDescription2 subpass{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = resolves ? &colourSamples : &colourAt;
    subpass.pDepthStencilAttachment = resolves ? &depthSamples : &depthAt;
    subpass.pResolveAttachments = resolves ? &colourAt : nullptr;
    subpass.pNext = resolves ? &depthResolve : nullptr;
    const std::array<VkSubpassDependency2, 2> between = dependencies();
    VkRenderPassCreateInfo2 info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2};
    info.attachmentCount = resolves ? 4 : 2;
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(between.size());
    info.pDependencies = between.data();
    return gpu::owned(device.handle(), vkCreateRenderPass2, vkDestroyRenderPass, info,
                      "making a render pass");
}

DeviceImage image(const WindowDevice& device, Attachment attachment, VkFormat colour,
                  VkExtent2D size)
{
    const VkAttachmentDescription2 described = description(attachment, colour, device.samples());
    const bool isKept = attachment == kColour || attachment == kDepth;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = described.format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = described.samples;
    info.usage = isDepth(attachment) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                     : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.usage |=
        isKept ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    return {device.gpu(), info,
            isDepth(attachment) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT};
}

} // namespace

Target::Target(const WindowDevice& device, VkFormat colour, uint32_t width, uint32_t height)
    : device_(device), format_(colour), pass_(renderPass(device, colour))
{
    resize(width, height);
}

void Target::resize(uint32_t width, uint32_t height)
{
    size_ = {std::max(width, 1u), std::max(height, 1u)};
    framebuffer_ = {};
    colour_ = image(device_, kColour, format_, size_);
    depth_ = image(device_, kDepth, format_, size_);
    std::vector<VkImageView> views{colour_.view(), depth_.view()};
    if (device_.samples() != VK_SAMPLE_COUNT_1_BIT) {
        colourSamples_ = image(device_, kColourSamples, format_, size_);
        depthSamples_ = image(device_, kDepthSamples, format_, size_);
        views.insert(views.end(), {colourSamples_.view(), depthSamples_.view()});
    }
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pass_.get();
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size_.width;
    info.height = size_.height;
    info.layers = 1;
    framebuffer_ = gpu::owned(device_.handle(), vkCreateFramebuffer, vkDestroyFramebuffer, info,
                              "making a framebuffer");
}

void Target::begin(VkCommandBuffer commands, const std::array<float, 4>& clear) const
{
    std::array<VkClearValue, 4> values{};
    for (const Attachment attachment : {kColour, kColourSamples})
        std::memcpy(values[attachment].color.float32, clear.data(), sizeof(clear));
    for (const Attachment attachment : {kDepth, kDepthSamples})
        values[attachment].depthStencil.depth = 1.0f;
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
    VkBufferImageCopy all{};
    all.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    all.imageExtent = {size_.width, size_.height, 1};
    return read(colour_, all, bytesAPixel);
}

float Target::depthAt(uint32_t x, uint32_t y) const
{
    if (x >= size_.width || y >= size_.height) return 1.0f;
    VkBufferImageCopy pixel{};
    pixel.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    pixel.imageOffset = {static_cast<int32_t>(x), static_cast<int32_t>(y), 0};
    pixel.imageExtent = {1, 1, 1};
    float depth = 1.0f;
    std::memcpy(&depth, read(depth_, pixel, sizeof(depth)).data(), sizeof(depth));
    return depth;
}

std::vector<std::byte> Target::read(const DeviceImage& image, const VkBufferImageCopy& part,
                                    size_t bytesAPixel) const
{
    const gpu::Buffer pixels(device_.gpu(),
                             bytesAPixel * part.imageExtent.width * part.imageExtent.height,
                             gpu::Place::host, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    gpu::Commands commands(device_.gpu());
    vkCmdCopyImageToBuffer(commands.handle(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           pixels.handle(), 1, &part);
    commands.run();
    return {pixels.bytes().begin(), pixels.bytes().end()};
}
