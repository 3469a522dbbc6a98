#include "viewer.h"

#include "gpu/commands.h"
#include "relamp/error.h"

#include <array>
#include <cstring>

#include <glm/gtc/packing.hpp>

namespace
{

constexpr std::array<float, 4> kGround{0.045f, 0.047f, 0.052f,
                                       1.0f}; // of the picture, where nothing is

} // namespace

void Viewer::drawView(VkCommandBuffer commands, VkRenderPass pass, const VkRect2D& frame,
                      bool linear)
{
    Scene scene;
    scene.frame = scene.area = frame;
    scene.clip = clip();
    scene.layer = available(shown.layer);
    scene.atlas = shown.atlas;
    scene.wireframe = shown.wireframe;
    scene.lamps = scene.sky = scene.layer == Layer::relit;
    scene.linear = linear;
    scene.view = studio.edit.view;
    if (linear) scene.view.exposure = 0.0f;
    if (!shown.compares) return drawing_.draw(commands, pass, scene);
    const auto left = static_cast<uint32_t>(shown.slider * static_cast<float>(frame.extent.width));
    scene.area.offset.x += static_cast<int32_t>(left);
    scene.area.extent.width -= left;
    drawing_.draw(commands, pass, scene);
    scene.area = frame;
    scene.area.extent.width = left;
    scene.layer = available(shown.before);
    scene.lamps = scene.sky = scene.layer == Layer::relit;
    drawing_.draw(commands, pass, scene);
}

void Viewer::drawWindow(VkCommandBuffer commands, bool withPanels)
{
    target_.begin(commands, kGround);
    drawView(commands, target_.pass(), frame(), false);
    if (withPanels) PanelDrawing::draw(commands);
    Target::end(commands);
}

void Viewer::drawFrame()
{
    if (window_.pixels().x == 0) return;
    const auto draw = [this](VkCommandBuffer commands) { drawWindow(commands, true); };
    if (!swapchain_.show(draw, target_.colour(), target_.size())) {
        const glm::ivec2 pixels = window_.pixels();
        swapchain_.resize({static_cast<uint32_t>(pixels.x), static_cast<uint32_t>(pixels.y)});
    }
    ++framesDrawn_;
}

relamp::Image Viewer::lightOfView()
{
    const VkExtent2D size = frame().extent;
    constexpr VkFormat kHalves = VK_FORMAT_R16G16B16A16_SFLOAT;
    if (!still_)
        still_ = std::make_unique<Target>(device_, kHalves, size.width, size.height);
    else
        still_->resize(size.width, size.height);
    relamp::gpu::Commands commands(device_.gpu());
    still_->begin(commands.handle(), {0.0f, 0.0f, 0.0f, 1.0f});
    drawView(commands.handle(), still_->pass(), {{0, 0}, size}, true);
    Target::end(commands.handle());
    commands.run();
    const std::vector<std::byte> pixels = still_->pixels(8);
    relamp::Image image;
    image.width = static_cast<int>(size.width);
    image.height = static_cast<int>(size.height);
    image.transfer = relamp::Transfer::linear;
    std::vector<uint16_t> half(3 * image.pixels());
    for (size_t i = 0; i < image.pixels(); ++i) std::memcpy(&half[3 * i], &pixels[8 * i], 6);
    image.rgb = std::move(half);
    return image;
}

/// What a person sees: the whole window, or the view alone.
relamp::Image Viewer::pictureOf(bool onlyView)
{
    const VkRect2D part = onlyView ? frame() : VkRect2D{{0, 0}, target_.size()};
    relamp::gpu::Commands commands(device_.gpu());
    drawWindow(commands.handle(), !onlyView);
    commands.run();
    const std::vector<std::byte> pixels = target_.pixels(4);
    relamp::Image image;
    image.width = static_cast<int>(part.extent.width);
    image.height = static_cast<int>(part.extent.height);
    std::vector<uint8_t> rgb(3 * image.pixels());
    size_t to = 0;
    for (uint32_t y = 0; y < part.extent.height; ++y)
        for (uint32_t x = 0; x < part.extent.width; ++x, to += 3) {
            const size_t from =
                size_t{y + static_cast<uint32_t>(part.offset.y)} * target_.size().width + x +
                static_cast<uint32_t>(part.offset.x);
            std::memcpy(&rgb[to], &pixels[4 * from], 3);
        }
    image.rgb = std::move(rgb);
    return image;
}

void Viewer::screenshot(const std::filesystem::path& file, bool onlyView)
{
    relamp::Progress progress;
    relamp::writeImage(file.extension() == ".exr" ? lightOfView() : pictureOf(onlyView), file,
                       progress);
}
