#pragma once

#include "albedo/page_layers.gpu.h"
#include "albedo/page_layers.h"
#include "gpu/commands.h"
#include "image/padding_gpu.h"
#include "scan/texels_gpu.h"

#include <cstddef>
#include <cstdint>

namespace relamp
{

/// The layers of a page on a GPU.
struct LayerPictures
{
    LayerPictures(const gpu::Device& device, uint32_t width, uint32_t height);
    /// Makes them those of no page, before they are another's.
    void clear(gpu::Commands& commands) const;
    /// Bytes that one takes on a device.
    static size_t bytesOf(size_t pixels);

    GpuPicture albedo;
    GpuPicture direct;
    GpuPicture indirect;
    gpu::Array<uint32_t> rating; // of pixels: confidence 0..255 and 256 times the doubt
};

/// makeLayers() on a GPU, from irradiance on.
class PageLayersGpu
{
public:
    PageLayersGpu(const gpu::Device& device, size_t surfels);

    /// From here on what is said of surfels is this. Waits until it is there.
    void setSurfels(const SolvedTexels& solved);

    /// A page that light is known on.
    struct LitPage
    {
        const GpuTexels& texels;
        const gpu::Array<glm::uvec2>& direct; // irradiance, halves
        const gpu::Array<glm::uvec2>& indirect;
        const Image& image;
    };
    /// Without padding. The commands run before the next page is divided.
    void divide(gpu::Commands& commands, const LitPage& page, const AlbedoOptions& options,
                const LayerPictures& out);

    /// That of setSurfels().
    [[nodiscard]] const Linearization& linearization() const { return linearization_; }

private:
    gpu::Program program_;
    gpu::Array<glm::vec4> rims_;
    gpu::Array<glm::vec4> trust_;
    gpu::Array<glm::vec4> around_;
    gpu::Array<glm::vec4> white_;
    gpu::Array<PageConstants> constants_; // one
    glm::vec4 tempering_{1.0f};
    float threshold_ = 0.0f;
    Linearization linearization_;
    bool fills_ = false;
};

/// Fetches the layers of a page. What shines is the texture's own and comes from there.
PageLayers layersFrom(const LayerPictures& pictures, const Texels& texels, size_t page,
                      const Linearization& linearization);

} // namespace relamp
