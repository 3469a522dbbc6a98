#include "pipelines.h"

#include "room_mesh.h"

#include "gpu/program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace gpu = relamp::gpu;

namespace
{

#include "lamp_frag.h"
#include "lamp_vert.h"
#include "room_frag.h"
#include "room_vert.h"
#include "sky_frag.h"
#include "sky_vert.h"

/// The shaders' constants 0 to 4.
struct Constants
{
    VkBool32 ofVertices;
    VkBool32 atlas;
    int32_t layer;
    int32_t view;
    VkBool32 lines;
};

/// Where vertices lie in their buffers: room ones in two, for the light changes alone.
struct VertexLayout
{
    std::array<VkVertexInputBindingDescription, 2> bindings{};
    std::array<VkVertexInputAttributeDescription, 5> attributes{};
    VkPipelineVertexInputStateCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};

    explicit VertexLayout(Subject subject)
    {
        if (subject == Subject::sky) return; // its corners are known by their numbers
        const bool lamp = subject == Subject::lamp;
        constexpr VkFormat kVec3 = VK_FORMAT_R32G32B32_SFLOAT;
        bindings[0] = {0, lamp ? 24u : uint32_t{sizeof(RoomVertex)}, VK_VERTEX_INPUT_RATE_VERTEX};
        bindings[1] = {1, 24, VK_VERTEX_INPUT_RATE_VERTEX};
        attributes[0] = {0, 0, kVec3, 0};
        attributes[1] = lamp ? VkVertexInputAttributeDescription{1, 0, kVec3, 12}
                             : VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32_SFLOAT,
                                                                 offsetof(RoomVertex, uv)};
        attributes[2] = {2, 0, kVec3, offsetof(RoomVertex, colour)};
        attributes[3] = {3, 1, kVec3, 0};
        attributes[4] = {4, 1, kVec3, 12};
        info.vertexBindingDescriptionCount = lamp ? 1 : 2;
        info.pVertexBindingDescriptions = bindings.data();
        info.vertexAttributeDescriptionCount = lamp ? 2 : 5;
        info.pVertexAttributeDescriptions = attributes.data();
    }
    VertexLayout(const VertexLayout&) = delete;
    VertexLayout& operator=(const VertexLayout&) = delete;
};

/// Lines let the surface shine through.
VkPipelineColorBlendAttachmentState blendOf(const Drawing& drawing)
{
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = drawing.lines ? VK_TRUE : VK_FALSE;
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorBlendOp = VK_BLEND_OP_ADD;
    blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.alphaBlendOp = VK_BLEND_OP_ADD;
    blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    return blend;
}

/// The room is looked into past the backs of its near walls, whatever layer it shows.
VkPipelineRasterizationStateCreateInfo rasterOf(const Drawing& drawing)
{
    VkPipelineRasterizationStateCreateInfo raster{
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    const bool isCulled = drawing.subject == Subject::room && !drawing.atlas;
    raster.cullMode = isCulled ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    return raster;
}

} // namespace

Pipelines::Pipelines(const WindowDevice& device, VkDescriptorSetLayout layers)
    : device_(device), roomVertex_(gpu::shaderOf(device.gpu(), kRoomVert)),
      roomFragment_(gpu::shaderOf(device.gpu(), kRoomFrag)),
      lampVertex_(gpu::shaderOf(device.gpu(), kLampVert)),
      lampFragment_(gpu::shaderOf(device.gpu(), kLampFrag)),
      skyVertex_(gpu::shaderOf(device.gpu(), kSkyVert)),
      skyFragment_(gpu::shaderOf(device.gpu(), kSkyFrag))
{
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                   std::max(sizeof(Push), sizeof(SkyPush))};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &layers;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    layout_ = gpu::owned(device.handle(), vkCreatePipelineLayout, vkDestroyPipelineLayout, info,
                         "making a pipeline layout");
}

VkPipeline Pipelines::of(const Drawing& drawing, VkRenderPass pass)
{
    gpu::Owned<VkPipeline>& pipeline = made_[{pass, drawing}];
    if (!pipeline) pipeline = make(drawing, pass);
    return pipeline.get();
}

std::pair<VkShaderModule, VkShaderModule> Pipelines::shadersOf(Subject subject) const
{
    switch (subject) {
    case Subject::room:
        break;
    case Subject::lamp:
        return {lampVertex_.get(), lampFragment_.get()};
    case Subject::sky:
        return {skyVertex_.get(), skyFragment_.get()};
    }
    return {roomVertex_.get(), roomFragment_.get()};
}

gpu::Owned<VkPipeline> Pipelines::make(const Drawing& drawing, VkRenderPass pass) const
{
    const Constants constants{drawing.ofVertices, drawing.atlas, drawing.layer, drawing.view,
                              drawing.lines};
    const std::array<VkSpecializationMapEntry, 5> entries{{{0, offsetof(Constants, ofVertices), 4},
                                                           {1, offsetof(Constants, atlas), 4},
                                                           {2, offsetof(Constants, layer), 4},
                                                           {3, offsetof(Constants, view), 4},
                                                           {4, offsetof(Constants, lines), 4}}};
    const VkSpecializationInfo specialised{static_cast<uint32_t>(entries.size()), entries.data(),
                                           sizeof(constants), &constants};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
        stage.pSpecializationInfo = &specialised;
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    std::tie(stages[0].module, stages[1].module) = shadersOf(drawing.subject);

    const VertexLayout vertices(drawing.subject);
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology =
        drawing.lines ? VK_PRIMITIVE_TOPOLOGY_LINE_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    const VkPipelineRasterizationStateCreateInfo raster = rasterOf(drawing);
    VkPipelineMultisampleStateCreateInfo samples{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = device_.samples();
    VkPipelineDepthStencilStateCreateInfo depth{
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = VK_TRUE;
    const bool isNowhere = drawing.lines || drawing.subject == Subject::sky;
    depth.depthWriteEnable = isNowhere ? VK_FALSE : VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    const VkPipelineColorBlendAttachmentState blend = blendOf(drawing);
    VkPipelineColorBlendStateCreateInfo blending{
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = 1;
    blending.pAttachments = &blend;
    const std::array<VkDynamicState, 2> changing{VK_DYNAMIC_STATE_VIEWPORT,
                                                 VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<uint32_t>(changing.size());
    dynamic.pDynamicStates = changing.data();

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertices.info;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamic;
    info.layout = layout_.get();
    info.renderPass = pass;
    VkPipeline made = nullptr;
    gpu::check(vkCreateGraphicsPipelines(device_.handle(), nullptr, 1, &info, nullptr, &made),
               "making a pipeline");
    return {device_.handle(), made, vkDestroyPipeline};
}
