#include "solve/reevaluate_gpu.h"

#include "shading/gathered_light.shared.h"
#include "solve/reevaluate.comp.h"
#include "solve/reevaluate.gpu.h"

#include <algorithm>
#include <optional>

namespace relamp
{
namespace
{

std::vector<double> numbersOf(std::span<const glm::vec3> values)
{
    std::vector<double> numbers;
    for (const glm::vec3 value : values)
        for (int c = 0; c < 3; ++c) numbers.push_back(static_cast<double>(value[c]));
    return numbers;
}

/// Scales that take the most of every lamp's light to 1, where halves are finest.
std::vector<float> scalesOf(const SolvedRoom& room)
{
    std::vector<float> scales;
    for (size_t l = 0; l < room.light->lamps->count(); ++l) {
        float most = 0.0f;
        const LampSight& onSides = onSidesOf(room.found, l);
        for (size_t i = 0; i < onSides.size(); ++i) most = std::max(most, onSides[i].open);
        scales.push_back(most > 0.0f ? 1.0f / most : 1.0f);
    }
    return scales;
}

std::vector<std::vector<float>> onListsOf(const SolvedRoom& room)
{
    std::vector<std::vector<float>> onLists;
    for (size_t l = 0; l < room.light->lamps->count(); ++l) {
        std::vector<float>& ofLamp = onLists.emplace_back();
        const LampSight& onSides = onSidesOf(room.found, l);
        for (size_t i = 0; i < onSides.size(); ++i) ofLamp.push_back(onSides[i].visible);
    }
    return onLists;
}

/// For pages, beside the pictures of one.
uint64_t budgetOf(const gpu::Device& device, uint64_t budget, const Texels& texels)
{
    uint64_t pictures = 0;
    for (const Page& page : texels.scan->pages)
        pictures = std::max<uint64_t>(pictures, LayerPictures::bytesOf(page.image.pixels()));
    if (budget == 0) budget = usualBudget(device);
    return budget > pictures ? budget - pictures : 1;
}

} // namespace

/// A page on the device, what was computed of it, and from what.
struct ReevaluateGpu::Page
{
    Page(const gpu::Device& device, const Texels& all, size_t page,
         const Linearization& linearization, size_t lamps)
        : texels(device, all, page, linearization),
          terms(device, LampTermsGpu::termsOf(lamps, texels.count)), direct(device, texels.count),
          indirect(device, texels.count)
    {}

    static uint64_t bytesOf(const Texels& all, size_t page, size_t lamps)
    {
        const size_t count = all.pages[page].count();
        return GpuTexels::bytesOf(all, page) +
               sizeof(uint32_t) * LampTermsGpu::termsOf(lamps, count) +
               2 * sizeof(glm::uvec2) * count;
    }

    GpuTexels texels;
    gpu::Array<uint32_t> terms;
    gpu::Array<glm::uvec2> direct;
    gpu::Array<glm::uvec2> indirect;
    StageInputs termsOf, shadingOf;
};

ReevaluateGpu::ReevaluateGpu(const gpu::Device& device, const Texels& texels,
                             const SolvedRoom& room, uint64_t budget)
    : device_(device), texels_(texels), shade_(device, kReevaluateSpirv),
      surfels_(device, texels.surfels), sides_(device, room.found.hits, room.found.radiance,
                                               {room.found.sides.field.shines, room.lit}),
      lamps_(device, texels.surfels, *room.light->lamps, scalesOf(room)),
      layers_(device, texels.surfels.count()), padding_(device),
      termsOfLists_(lamps_.keep(onListsOf(room), sides_.lists())),
      directOfLists_(device, sides_.lists()),
      pages_(
          device, texels.pages.size(), budgetOf(device, budget, texels),
          [&texels, lamps = room.light->lamps->count()](size_t page) {
              return Page::bytesOf(texels, page, lamps);
          },
          [&device, &texels, linearization = room.found.linearization,
           lamps = room.light->lamps->count()](size_t page) {
              return std::make_unique<Page>(device, texels, page, linearization, lamps);
          })
{}

ReevaluateGpu::~ReevaluateGpu() = default;

std::vector<gpu::Timing> ReevaluateGpu::gather(const LampPowers& powers,
                                               std::span<const uint8_t> shines)
{
    const bool areNew = powers_.change(numbersOf(powers.lamps));
    if (!std::equal(shines.begin(), shines.end(), shines_.begin(), shines_.end())) {
        sides_.setShining(shines);
        shines_.assign(shines.begin(), shines.end());
        ++shining_;
    }
    const glm::vec3 even = powers.outside.even(); // the ratios of its parts are the room's
    std::vector<double> inputs = numbersOf({&even, 1});
    inputs.insert(inputs.end(), {powers_.version(), shining_});
    if (!gathered_.change(std::move(inputs))) return {};
    sides_.setOutside(powers.outside);
    gpu::Commands commands(device_);
    commands.mark("gather");
    if (areNew) {
        lamps_.setPowers(commands, powers.lamps);
        lamps_.sum(commands, termsOfLists_, directOfLists_);
    }
    sides_.light(commands, surfels_, directOfLists_);
    commands.run();
    return commands.timings();
}

std::vector<gpu::Timing> ReevaluateGpu::shade(size_t index)
{
    Page& page = pages_[index];
    last_ = index;
    gpu::Commands commands(device_);
    if (page.termsOf.change({})) {
        commands.mark("lamps");
        lamps_.keep(commands, page.texels, surfels_, page.terms);
    }
    if (page.shadingOf.change({gathered_.version()})) {
        commands.mark("shading");
        const float reach = kInterpolationReach * surfels_.size;
        commands.dispatch(shade_, page.texels.count,
                          ReevaluateArguments{.site = page.texels.site.ref(),
                                              .surfel = page.texels.surfel.ref(),
                                              .position = surfels_.position.ref(),
                                              .normal = surfels_.normal.ref(),
                                              .firstNeighbor = surfels_.firstNeighbor.ref(),
                                              .neighbor = surfels_.neighbor.ref(),
                                              .indirect = sides_.indirect().ref(),
                                              .lamps = lamps_.lit(page.terms, page.texels.count),
                                              .directOut = page.direct.ref(),
                                              .indirectOut = page.indirect.ref(),
                                              .perReachSquared = 1.0f / (reach * reach)});
        commands.barrier();
    }
    commands.run();
    return commands.timings();
}

void ReevaluateGpu::setSurfels(const SolvedTexels& solved)
{
    ++said_;
    layers_.setSurfels(solved);
}

/// Makes the pictures this page's.
void ReevaluateGpu::takeLayers(gpu::Commands& commands, size_t page)
{
    const Image& image = texels_.scan->pages[page].image;
    const Image& before = texels_.scan->pages[picturesOf_].image;
    const bool fits = pictures_ && image.width == before.width && image.height == before.height;
    if (fits && page != picturesOf_) pictures_->clear(commands);
    if (!fits) {
        pictures_.reset(); // that two are not there at once
        pictures_.emplace(device_, static_cast<uint32_t>(image.width),
                          static_cast<uint32_t>(image.height));
    }
    picturesOf_ = page;
}

std::vector<gpu::Timing> ReevaluateGpu::divide(size_t index, const AlbedoOptions& options)
{
    std::vector<gpu::Timing> timings = shade(index);
    Page& page = pages_[index];
    const bool isAsBefore =
        !divided_.change({static_cast<double>(index), gathered_.version(), said_,
                          static_cast<double>(options.darkest), options.fill ? 1.0 : 0.0});
    if (isAsBefore && pictures_) return timings; // memory may have been short for them
    const relamp::Page& scanned = texels_.scan->pages[index];
    gpu::Commands commands(device_);
    commands.mark("divide");
    takeLayers(commands, index);
    layers_.divide(commands, {page.texels, page.direct, page.indirect, scanned.image}, options,
                   *pictures_);
    if (!scanned.ofVertices) { // its pixels have no neighbours
        commands.mark("padding");
        padding_.fill(commands, {pictures_->albedo, pictures_->direct, pictures_->indirect});
    }
    commands.run();
    const std::vector<gpu::Timing> ofLayers = commands.timings();
    timings.insert(timings.end(), ofLayers.begin(), ofLayers.end());
    return timings;
}

std::vector<glm::vec4> ReevaluateGpu::indirectOnSurfels() const
{
    return sides_.indirect().download();
}

PageIrradiance ReevaluateGpu::irradiance() const
{
    return {pages_[last_].direct.download(), pages_[last_].indirect.download()};
}

PageLayers ReevaluateGpu::layers() const
{
    return layersFrom(*pictures_, texels_, picturesOf_, layers_.linearization());
}

} // namespace relamp
