#include "room_drawing.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace gpu = relamp::gpu;

namespace
{

constexpr int kGlance = 8;             // shaders/layers.glsl
constexpr uint32_t kLargestSky = 4096; // pixels

gpu::Owned<VkDescriptorSetLayout> layoutOfLayers(const WindowDevice& device)
{
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = kPageTextures;
    binding.stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = 1;
    info.pBindings = &binding;
    return gpu::owned(device.handle(), vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout,
                      info, "making a layout");
}

VkSamplerAddressMode addressOf(relamp::Wrap wrap)
{
    switch (wrap) {
    case relamp::Wrap::repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case relamp::Wrap::mirror:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case relamp::Wrap::clamp:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

TexturePixels greyPixel(std::byte value)
{
    TexturePixels pixels;
    pixels.levels.push_back({1, 1, 0});
    pixels.bytes.assign(4, value);
    return pixels;
}

/// What is drawn from; none of nothing.
template<class T>
gpu::Buffer drawn(const WindowDevice& device, std::span<const T> values, VkBufferUsageFlags usage)
{
    if (values.empty()) return {};
    gpu::Buffer buffer(device.gpu(), values.size_bytes(), gpu::Place::device,
                       usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    buffer.upload(std::as_bytes(values));
    return buffer;
}

} // namespace

RoomDrawing::RoomDrawing(const WindowDevice& device)
    : device_(device), setLayout_(layoutOfLayers(device)), pipelines_(device, setLayout_.get()),
      nothing_(uploaded(device.gpu(), greyPixel(std::byte{0}))),
      skyPicture_(uploaded(device.gpu(), greyPixel(std::byte{255})))
{}

void RoomDrawing::setMesh(const RoomMesh& mesh, size_t pages)
{
    device_.gpu().wait();
    surfaces_ = mesh.surfaces;
    vertices_ = drawn(device_, std::span(mesh.vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices_ = drawn(device_, std::span(mesh.indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    edges_ = drawn(device_, std::span(mesh.edges), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    const std::vector<relamp::LightAtPlace> dark(mesh.vertices.size());
    light_ = drawn(device_, std::span(dark), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    hasLight_ = false;
    pages_.clear();
    pages_.resize(pages);
    makePool();
}

void RoomDrawing::makePool()
{
    constexpr uint32_t kWrapPairs = 9;
    sets_.clear();
    skySet_ = nullptr;
    pool_ = {};
    const auto sets = static_cast<uint32_t>(pages_.size()) * kWrapPairs + 1; // the sky's
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                    sets * static_cast<uint32_t>(kPageTextures)};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = sets;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    pool_ = gpu::owned(device_.handle(), vkCreateDescriptorPool, vkDestroyDescriptorPool, info,
                       "making descriptors");
}

void RoomDrawing::setTexture(size_t page, PageTexture which, const TexturePixels& pixels)
{
    device_.gpu().wait();
    pages_[page].images[static_cast<size_t>(which)] = uploaded(device_.gpu(), pixels);
    if (which == PageTexture::scan)
        pages_[page].aspect = static_cast<float>(pixels.levels[0].width) /
                              static_cast<float>(pixels.levels[0].height);
    makePool();
}

void RoomDrawing::removeTextures(PageTexture which)
{
    device_.gpu().wait();
    for (PageImages& page : pages_) page.images[static_cast<size_t>(which)] = {};
    makePool();
}

void RoomDrawing::setLight(std::span<const relamp::LightAtPlace> atVertices)
{
    if (std::as_bytes(atVertices).size() != light_.size()) return; // of another room
    light_.upload(std::as_bytes(atVertices));
    hasLight_ = true;
}

void RoomDrawing::setLamps(std::span<const LampVertex> triangles)
{
    device_.gpu().wait();
    lampVertices_ = static_cast<uint32_t>(triangles.size());
    if (lampVertices_ > 0) lamps_ = drawn(device_, triangles, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
}

void RoomDrawing::setSky(const relamp::Sky& sky)
{
    const bool isSame = sky.environment == sky_.environment;
    sky_ = sky;
    if (isSame) return;
    device_.gpu().wait();
    skyPicture_ = uploaded(device_.gpu(), sky.environment
                                              ? texturePixels(*sky.environment, TexelFormat::rgb9e5,
                                                              kLargestSky, false)
                                              : greyPixel(std::byte{255}));
    makePool();
}

bool RoomDrawing::hasTexture(PageTexture which) const
{
    if (pages_.empty()) return false;
    for (const PageImages& page : pages_)
        if (!page.images[static_cast<size_t>(which)]) return false;
    return true;
}

bool RoomDrawing::has(Layer layer) const
{
    switch (layer) {
    case Layer::scan:
        return hasTexture(PageTexture::scan);
    case Layer::flattened:
        return hasTexture(PageTexture::flattened);
    case Layer::direct:
        return hasTexture(PageTexture::direct);
    case Layer::indirect:
        return hasTexture(PageTexture::indirect);
    case Layer::shading:
        return hasTexture(PageTexture::direct) && hasTexture(PageTexture::indirect);
    case Layer::albedo:
        return hasTexture(PageTexture::albedo);
    case Layer::confidence:
        return hasTexture(PageTexture::confidence);
    case Layer::relit:
        return hasTexture(PageTexture::relit) || (hasLight_ && hasTexture(PageTexture::albedo));
    }
    return false;
}

VkSampler RoomDrawing::samplerOf(Wraps wraps)
{
    gpu::Owned<VkSampler>& sampler = samplers_[wraps];
    if (sampler) return sampler.get();
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = VK_FILTER_LINEAR;
    info.minFilter = VK_FILTER_LINEAR;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = addressOf(wraps.first);
    info.addressModeV = addressOf(wraps.second);
    // Without hardware for it, eight looks into a texture cost eight times one.
    info.anisotropyEnable = device_.isAnisotropic() ? VK_TRUE : VK_FALSE;
    info.maxAnisotropy = 8.0f;
    info.maxLod = VK_LOD_CLAMP_NONE;
    sampler =
        gpu::owned(device_.handle(), vkCreateSampler, vkDestroySampler, info, "making a sampler");
    return sampler.get();
}

VkDescriptorSet RoomDrawing::setOf(int page, Wraps wraps)
{
    VkDescriptorSet& set = sets_[{page, wraps}];
    if (set != nullptr) return set;
    Views views{};
    for (size_t t = 0; t < kPageTextures; ++t) {
        const DeviceImage& image = pages_[static_cast<size_t>(page)].images[t];
        views[t] = image ? image.view() : nothing_.view();
    }
    set = newSet(views, samplerOf(wraps));
    return set;
}

VkDescriptorSet RoomDrawing::skySet()
{
    if (skySet_ != nullptr) return skySet_;
    Views views{};
    views.fill(skyPicture_.view());
    skySet_ = newSet(views, samplerOf({relamp::Wrap::repeat, relamp::Wrap::clamp}));
    return skySet_;
}

VkDescriptorSet RoomDrawing::newSet(const Views& views, VkSampler sampler)
{
    VkDescriptorSetLayout layout = setLayout_.get();
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool_.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    VkDescriptorSet set = nullptr;
    gpu::check(vkAllocateDescriptorSets(device_.handle(), &allocate, &set), "making descriptors");
    std::array<VkDescriptorImageInfo, kPageTextures> images{};
    for (size_t t = 0; t < kPageTextures; ++t)
        images[t] = {sampler, views[t], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = kPageTextures;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = images.data();
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    return set;
}

void RoomDrawing::draw(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene)
{
    if (surfaces_.empty() || scene.area.extent.width == 0 || scene.area.extent.height == 0) return;
    const VkViewport viewport{static_cast<float>(scene.frame.offset.x),
                              static_cast<float>(scene.frame.offset.y),
                              static_cast<float>(scene.frame.extent.width),
                              static_cast<float>(scene.frame.extent.height),
                              0.0f,
                              1.0f};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scene.area);
    drawSurfaces(commands, pass, scene, false);
    if (scene.wireframe) drawSurfaces(commands, pass, scene, true);
    if (scene.lamps && !scene.atlas) drawLamps(commands, pass, scene);
    if (scene.sky && !scene.atlas && sky_.radiance != glm::vec3(0.0f))
        drawSky(commands, pass, scene);
}

void RoomDrawing::drawSurfaces(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene,
                               bool lines)
{
    const VkBuffer buffers[] = {vertices_.handle(), light_.handle()};
    const VkDeviceSize offsets[] = {0, 0};
    vkCmdBindVertexBuffers(commands, 0, 2, buffers, offsets);
    vkCmdBindIndexBuffer(commands, (lines ? edges_ : indices_).handle(), 0, VK_INDEX_TYPE_UINT32);
    Drawing drawing{.layer = static_cast<int>(scene.layer),
                    .view = scene.linear ? 3 : static_cast<int>(scene.view.view),
                    .atlas = scene.atlas,
                    .lines = lines};
    if (scene.layer == Layer::relit && !hasTexture(PageTexture::relit)) drawing.layer = kGlance;
    for (const RoomSurface& surface : surfaces_) {
        drawing.ofVertices = surface.ofVertices;
        Push push{scene.clip, std::exp2(scene.view.exposure)};
        if (scene.atlas)
            push.clipFromWorld = glm::scale(
                glm::translate(scene.clip, {1.05f * static_cast<float>(surface.page), 0.0f, 0.0f}),
                {1.0f, 1.0f / pages_[static_cast<size_t>(surface.page)].aspect, 1.0f});
        if (lines) // a little nearer than the surface that they lie on
            push.clipFromWorld =
                glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -2e-5f}) * push.clipFromWorld;
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.of(drawing, pass));
        const VkDescriptorSet set = setOf(surface.page, {surface.wrapU, surface.wrapV});
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout(), 0,
                                1, &set, 0, nullptr);
        vkCmdPushConstants(commands, pipelines_.layout(),
                           VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                           sizeof(push), &push);
        vkCmdDrawIndexed(commands, lines ? surface.edges : surface.indices, 1,
                         lines ? surface.firstEdge : surface.firstIndex, 0, 0);
    }
}

void RoomDrawing::drawLamps(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene)
{
    if (lampVertices_ == 0) return;
    const Push push{scene.clip, std::exp2(scene.view.exposure)};
    const Drawing drawing{.view = scene.linear ? 3 : static_cast<int>(scene.view.view),
                          .subject = Subject::lamp};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.of(drawing, pass));
    vkCmdPushConstants(commands, pipelines_.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push),
                       &push);
    const VkBuffer buffer = lamps_.handle();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdDraw(commands, lampVertices_, 1, 0, 0);
}

void RoomDrawing::drawSky(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene)
{
    const SkyPush push{glm::inverse(scene.clip), sky_.radiance, sky_.turn,
                       std::exp2(scene.view.exposure)};
    const Drawing drawing{.view = scene.linear ? 3 : static_cast<int>(scene.view.view),
                          .subject = Subject::sky};
    const VkDescriptorSet set = skySet();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.of(drawing, pass));
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout(), 0, 1,
                            &set, 0, nullptr);
    vkCmdPushConstants(commands, pipelines_.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push),
                       &push);
    vkCmdDraw(commands, 3, 1, 0, 0);
}
