#pragma once

#include "device_image.h"
#include "layers.h"
#include "pipelines.h"
#include "room_mesh.h"

#include "gpu/buffer.h"
#include "relamp/light_probes.h"
#include "relamp/relight.h"
#include "relamp/view.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

/// A corner of a triangle of a lamp's surface.
struct LampVertex
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec3 radiance{0.0f};
};

/// Part of the picture, in pixels, and what is shown there.
struct Scene
{
    VkRect2D frame{};     // what clip space stands for
    VkRect2D area{};      // what of it is drawn
    glm::mat4 clip{1.0f}; // from the world, or from the atlas, each page a unit to the right
    Layer layer = Layer::scan;
    bool atlas = false;
    bool wireframe = false;
    bool lamps = false;  // of new lights
    bool sky = false;    // where nothing else is, if it shines
    bool linear = false; // light itself, for EXR
    relamp::ViewOptions view;
};

/// The room on the graphics device, ready to be drawn in any layer that has come so far.
class RoomDrawing
{
public:
    explicit RoomDrawing(const WindowDevice& device);

    void setMesh(const RoomMesh& mesh, size_t pages);
    void setTexture(size_t page, PageTexture which, const TexturePixels& pixels);
    void removeTextures(PageTexture which);
    /// Light at the mesh's vertices. It is shown in the layer relit until there are textures of it.
    void setLight(std::span<const relamp::LightAtPlace> atVertices);
    void setLamps(std::span<const LampVertex> triangles);
    void setSky(const relamp::Sky& sky);

    /// What the device takes.
    [[nodiscard]] TextureLimits limits() const { return device_.textureLimits(); }
    /// Whether what a layer is made of is there.
    [[nodiscard]] bool has(Layer layer) const;
    [[nodiscard]] size_t pages() const { return pages_.size(); }
    [[nodiscard]] float aspectOf(size_t page) const { return pages_[page].aspect; }

    void draw(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene);

private:
    struct PageImages
    {
        std::array<DeviceImage, kPageTextures> images; // none where it has not come
        float aspect = 1.0f;                           // width / height
    };
    using Wraps = std::pair<relamp::Wrap, relamp::Wrap>;

    [[nodiscard]] bool hasTexture(PageTexture which) const;
    VkDescriptorSet setOf(int page, Wraps wraps);
    VkDescriptorSet skySet();
    using Views = std::array<VkImageView, kPageTextures>;
    VkDescriptorSet newSet(const Views& views, VkSampler sampler);
    VkSampler samplerOf(Wraps wraps);
    void makePool();
    void drawSurfaces(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene, bool lines);
    void drawLamps(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene);
    void drawSky(VkCommandBuffer commands, VkRenderPass pass, const Scene& scene);

    const WindowDevice& device_;
    relamp::gpu::Owned<VkDescriptorSetLayout> setLayout_;
    Pipelines pipelines_;
    std::map<Wraps, relamp::gpu::Owned<VkSampler>> samplers_;
    DeviceImage nothing_; // a black pixel, for what has not come
    relamp::Sky sky_;
    DeviceImage skyPicture_; // a white pixel where it has none
    std::vector<PageImages> pages_;
    relamp::gpu::Owned<VkDescriptorPool> pool_;
    std::map<std::pair<int, Wraps>, VkDescriptorSet> sets_;
    VkDescriptorSet skySet_ = nullptr;
    std::vector<RoomSurface> surfaces_;
    relamp::gpu::Buffer vertices_, light_, indices_, edges_, lamps_;
    uint32_t lampVertices_ = 0;
    bool hasLight_ = false;
};
