#include "solve/reevaluate_engine.h"

#include "relamp/error.h"

#include <utility>

namespace relamp
{
namespace
{

SettledLight settledBy(const ReevaluateGpu& gpu)
{
    SettledLight light;
    for (const glm::vec4 irradiance : gpu.gathered()) light.gathered.emplace_back(irradiance);
    for (const glm::vec4 irradiance : gpu.indirectOnSurfels())
        light.indirect.emplace_back(irradiance);
    return light;
}

/// A room is there for stages that are made meanwhile, and not after.
class Lent
{
public:
    Lent(const SolvedRoom*& place, const SolvedRoom& room) : place_(place) { place_ = &room; }
    ~Lent() { place_ = nullptr; }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;

private:
    const SolvedRoom*& place_;
};

} // namespace

ReevaluateEngine::ReevaluateEngine(const Texels& texels, const EngineOptions& options)
    : texels_(texels), gpu_(gpu::Choice::of(options), [this](const gpu::Device& device) {
          if (room_ == nullptr)
              throw Error(ErrorCode::device,
                          "the GPU failed at this room; take the light out of it "
                          "again, or leave that to the CPU (--engine cpu)");
          return std::make_unique<ReevaluateGpu>(device, texels_, *room_);
      })
{}

DeviceLayers ReevaluateEngine::reevaluate(SolvedRoom& room, const LampPowers& powers)
{
    const auto asked = std::make_shared<const Asked>(Asked{powers, shinesOf(room.found, powers)});
    SettledLight light;
    if (!settle(room, *asked, light)) {
        relamp::reevaluate(texels_, room, powers);
        return nullptr;
    }
    relamp::reevaluate(texels_, room, powers, std::move(light));
    return [self = shared_from_this(), asked](size_t page, const SolvedTexels& solved,
                                              const AlbedoOptions& options, Progress& progress) {
        const Progress::Stage stage(progress, "divide");
        progress.check();
        return self->layersOf(asked, page, solved, options);
    };
}

/// False where the CPU has to do it.
bool ReevaluateEngine::settle(const SolvedRoom& room, const Asked& asked, SettledLight& light)
{
    const std::unique_lock lock(mutex_);
    const Lent lent(room_, room);
    lit_ = nullptr;
    return gpu_.compute([&](ReevaluateGpu& gpu) {
        gpu.gather(asked.powers, asked.shines);
        light = settledBy(gpu);
    });
}

std::optional<PageLayers> ReevaluateEngine::layersOf(const std::shared_ptr<const Asked>& asked,
                                                     size_t page, const SolvedTexels& solved,
                                                     const AlbedoOptions& options)
{
    const std::unique_lock lock(mutex_);
    std::optional<PageLayers> layers;
    gpu_.compute([&](ReevaluateGpu& gpu) {
        if (lit_ != asked) {
            lit_ = nullptr;                           // until all of it is there
            gpu.gather(asked->powers, asked->shines); // nothing where these are still its own
            gpu.setSurfels(solved);
            lit_ = asked;
        }
        gpu.divide(page, options);
        layers = gpu.layers();
    });
    return layers;
}

gpu::InForce ReevaluateEngine::inForce() const
{
    const std::unique_lock lock(mutex_);
    return gpu_.inForce();
}

} // namespace relamp
