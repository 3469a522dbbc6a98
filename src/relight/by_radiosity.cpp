#include "relight/by_radiosity.h"

#include "base/parallel.h"
#include "shading/buried.h"
#include "shading/gathered_light.h"
#include "shading/lit_sides.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;

void addDirectOf(const LightSource& source, glm::vec3 emission, const TexelBlock& block,
                 const float* share, RgbBlock& out)
{
    float open[TexelBlock::kPadded];
    source.open(block, open);
    const glm::vec3 perIrradiance = emission / kPi;
    for (size_t i = 0; i < block.count; ++i) {
        out.r[i] += open[i] * share[i] * perIrradiance.r;
        out.g[i] += open[i] * share[i] * perIrradiance.g;
        out.b[i] += open[i] * share[i] * perIrradiance.b;
    }
}

/// No light comes to where something lies on the surface, though its surfel is lit beside that.
void darkenBuried(const Texels& texels, size_t page, size_t begin, size_t count, ShadingBlock& out)
{
    if (texels.buried.empty()) return;
    const uint8_t* buried = &texels.buried[page][begin];
    for (RgbBlock* light : {&out.direct, &out.indirect})
        for (float* channel : {light->r, light->g, light->b})
            for (size_t i = 0; i < count; ++i)
                if (buried[i] != 0) channel[i] = 0.0f;
}

} // namespace

RadiosityLight::RadiosityLight(const Texels& texels, const RayScene& scene,
                               const Transport& transport,
                               std::span<const std::vector<uint8_t>> isClipped, size_t shadowRays)
    : texels_(texels), scene_(scene), transport_(transport), isClipped_(isClipped),
      shadowRays_(shadowRays), isBuried_(buriedSurfels(texels))
{}

void RadiosityLight::findShadows(const ActiveLights& active, Progress& progress)
{
    Progress::Stage stage(progress, "shadows", 2 * std::max<size_t>(active.lights.size(), 1));
    const bool arePanesNew = panes_ != active.panes;
    panes_ = active.panes;
    const Obstacles walls(texels_, scene_, {}, isClipped_);
    const Obstacles wallsWithoutPanes(texels_, scene_, panes_, isClipped_);
    std::vector<std::shared_ptr<const ShadowedLight>> kept;
    std::swap(kept, lights_);
    for (const ActiveLight& light : active.lights) {
        const bool isSun = light.source->isSun();
        const auto isSame = [&](const auto& other) {
            return castSameShadows(other->light, light) && !(isSun && arePanesNew);
        };
        const auto found = std::find_if(kept.begin(), kept.end(), isSame);
        if (found != kept.end()) {
            lights_.push_back(*found);
            stage.advance(2);
            continue;
        }
        const Obstacles& obstacles = isSun ? wallsWithoutPanes : walls;
        std::vector<AreaSample> onSides =
            directOfSides(texels_, obstacles, *light.source, transport_.sides);
        stage.advance();
        Shadows shadows(texels_, obstacles, *light.source,
                        std::span(onSides).first(texels_.surfels.count()), shadowRays_);
        lights_.push_back(std::make_shared<const ShadowedLight>(
            ShadowedLight{light, std::move(onSides), std::move(shadows)}));
        stage.advance();
    }
}

void RadiosityLight::set(const ActiveLights& active, std::span<const glm::vec3> albedo,
                         Progress& progress)
{
    findShadows(active, progress);
    const Progress::Stage stage(progress, "bounces");
    std::vector<glm::vec3> direct(transport_.sides.size(), glm::vec3(0.0f));
    emissions_.clear();
    for (size_t l = 0; l < lights_.size(); ++l) {
        emissions_.push_back(active.lights[l].emission);
        addDirect(lights_[l]->onSides, emissions_[l], direct);
    }
    const Bounced bounced = bounce(transport_, albedo, direct, active.sky);
    indirect_ = std::make_shared<const std::vector<glm::vec3>>(
        withoutNoise(texels_.surfels, withoutBuried(texels_.surfels, bounced.irradiance, isBuried_),
                     bounced.noise));
}

TexelShading RadiosityLight::shading() const
{
    return [&texels = texels_, lights = lights_, emissions = emissions_, indirect = indirect_](
               size_t p, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        interpolate(texels, *indirect, p, begin, block, out.indirect);
        for (float* channel : {out.direct.r, out.direct.g, out.direct.b})
            std::fill_n(channel, block.count, 0.0f);
        float share[TexelBlock::kPadded];
        for (size_t l = 0; l < lights.size(); ++l)
            if (lights[l]->shadows.at(p, begin, block.count, share))
                addDirectOf(*lights[l]->light.source, emissions[l], block, share, out.direct);
        darkenBuried(texels, p, begin, block.count, out);
    };
}

} // namespace relamp
