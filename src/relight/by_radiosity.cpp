#include "relight/by_radiosity.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/light_correction.h"
#include "lights/shining.h"
#include "shading/direct_sum.h"
#include "shading/gathered_light.h"
#include "shading/lit_sides.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kRaysToGlow = 2; // of a surfel; the neighbours have as many

/// Share of a light that is seen from the middle of surfels. A few rays tell it, those of the
/// neighbours with them.
std::vector<float> smoothShares(const Surfels& surfels, const LampSight& onFronts)
{
    std::vector<float> shares(surfels.count());
    forEachChunk(surfels.count(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            float all = 0.0f;
            float seen = 0.0f;
            for (const uint32_t n : surfels.neighborsOf(s)) {
                const AreaSample sample = onFronts[n];
                all += sample.open;
                seen += sample.visible;
            }
            shares[s] = all > 0.0f ? seen / all : 0.0f;
        }
    });
    return shares;
}

/// Irradiance at emission 1 in the middle of surfels: how much there is to be seen is known
/// exactly.
std::vector<float> smoothOnFronts(const Surfels& surfels, const LightSource& source,
                                  const LampSight& onSides)
{
    std::vector<float> irradiance = smoothShares(surfels, onSides);
    forEachChunk(surfels.count(), TexelBlock::kCapacity, [&](size_t begin, size_t end) {
        TexelBlock block;
        loadSurfels(surfels, begin, end, block);
        float open[TexelBlock::kPadded];
        source.open(block, open);
        for (size_t s = begin; s < end; ++s) irradiance[s] *= open[s - begin];
    });
    return irradiance;
}

/// Other solvers follow their light on the CPU.
EngineOptions engineOf(const RelightOptions& options)
{
    return options.solver == Solver::gather ? options.engine : EngineOptions{.engine = Engine::cpu};
}

struct LightSet
{
    std::vector<std::shared_ptr<const ShadowedLight>> lights;
    std::vector<glm::vec3> emissions;
};

/// Their light on texels, straight.
TexelShading directOf(LightSet set)
{
    return
        [set = std::move(set)](size_t p, size_t begin, const TexelBlock& block, ShadingBlock& out) {
            darken(out.direct, block.count);
            darken(out.indirect, block.count);
            LampOnBlock on;
            for (size_t l = 0; l < set.lights.size(); ++l) {
                if (!set.lights[l]->shadows->at(p, begin, block.count, on.share)) continue;
                set.lights[l]->light.source->open(block, on.open);
                addDirect(on, set.emissions[l], block.count, out.direct);
            }
        };
}

void add(const RgbBlock& other, size_t texels, RgbBlock& sum)
{
    for (size_t i = 0; i < texels; ++i) {
        sum.r[i] += other.r[i];
        sum.g[i] += other.g[i];
        sum.b[i] += other.b[i];
    }
}

} // namespace

RadiosityLight::RadiosityLight(const Texels& texels, const RayScene& scene,
                               const Transport& transport,
                               std::span<const std::vector<bool>> isClipped,
                               std::span<const float> lit, const RelightOptions& options)
    : texels_(texels), scene_(scene), transport_(transport), isClipped_(isClipped), lit_(lit),
      shadowRays_(static_cast<size_t>(options.shadowRays)), engine_(transport, engineOf(options))
{}

std::shared_ptr<const ShadowedLight>
RadiosityLight::shadowed(const ActiveLight& light, std::shared_ptr<const ShadowedLight> known,
                         ShadowDetail detail, const Obstacles& obstacles) const
{
    if (known && (known->shadows || detail == ShadowDetail::sides)) return known;
    ShadowedLight result{light, {}, {}, std::nullopt};
    if (known) {
        result.onSides = known->onSides;
        result.onFronts = known->onFronts;
    } else {
        result.onSides = directOfSides(texels_, obstacles, *light.source, transport_.sides);
        result.onFronts = smoothOnFronts(texels_.surfels, *light.source, result.onSides);
    }
    if (detail == ShadowDetail::texels)
        result.shadows.emplace(texels_, obstacles, *light.source, result.onSides, shadowRays_);
    return std::make_shared<const ShadowedLight>(std::move(result));
}

void RadiosityLight::findShadows(const ActiveLights& active, ShadowDetail detail,
                                 Progress& progress)
{
    Progress::Stage stage(progress, "shadows", std::max<size_t>(active.lights.size(), 1));
    const bool areOpeningsNew = windowOpenings_ != active.windowOpenings;
    const Obstacles walls(texels_, scene_, {}, isClipped_);
    const Obstacles wallsWithOpenings(texels_, scene_, active.windowOpenings, isClipped_);
    std::vector<std::shared_ptr<const ShadowedLight>> found;
    for (const ActiveLight& light : active.lights) {
        const bool isSun = light.source->isSun();
        const auto isSame = [&](const auto& other) {
            return castSameShadows(other->light, light) && !(isSun && areOpeningsNew);
        };
        const auto known = std::find_if(lights_.begin(), lights_.end(), isSame);
        found.push_back(shadowed(light, known != lights_.end() ? *known : nullptr, detail,
                                 isSun ? wallsWithOpenings : walls));
        stage.advance();
    }
    lights_ = std::move(found); // all or, where somebody cancelled, none of it
    windowOpenings_ = active.windowOpenings;
}

/// Whether the light was there when it was found how much of it arrives.
bool RadiosityLight::isCorrected(size_t light) const
{
    const ActiveLight& active = lights_[light]->light;
    return !lit_.empty() && active.isFixture && active.fixture.id >= 0;
}

/// What each light makes glow; what rays found of that is kept as the light itself is.
void RadiosityLight::findGlows(std::span<const size_t> lights, std::span<const glm::vec3> albedo,
                               std::span<const glm::vec3> direct, const SeenGlows& known)
{
    const Surfels& surfels = texels_.surfels;
    const SentLight all = sentDirectly(transport_, surfels, albedo, direct);
    const Obstacles walls(texels_, scene_, {}, isClipped_);
    for (const size_t l : lights) {
        std::optional<Glow> glow =
            findGlow(transport_, texels_, albedo, lights_[l]->onSides, emissions_[l], all);
        if (!glow) continue;
        const auto same = std::find_if(known.begin(), known.end(), [&](const auto& other) {
            return other && other->light == lights_[l] && other->glow.sides == glow->sides;
        });
        if (same != known.end()) {
            glows_[l] = *same;
            continue;
        }
        const LightSource source{AreaLight(glow->patches)};
        const std::vector<float> shares =
            smoothShares(surfels, directOfSides(texels_, walls, source,
                                                std::span(transport_.sides).first(surfels.count()),
                                                kRaysToGlow));
        glows_[l] = std::make_shared<const SeenGlow>(
            SeenGlow{lights_[l], *glow, irradianceFrom(*glow, transport_, surfels, shares)});
    }
}

/// What some of the lights, and the sky, bring to fronts by way of other surfaces.
std::vector<glm::vec3> RadiosityLight::bounced(std::span<const size_t> lights,
                                               std::span<const glm::vec3> albedo,
                                               std::span<const glm::vec3> sky,
                                               const SeenGlows& known)
{
    std::vector<glm::vec3> direct(transport_.sides.size(), glm::vec3(0.0f));
    for (const size_t l : lights) addDirect(lights_[l]->onSides, emissions_[l], direct);
    findGlows(lights, albedo, direct, known);
    std::vector<glm::vec3> glowing; // direct light of sides that glow
    std::vector<glm::vec3> byGlow(texels_.surfels.count(), glm::vec3(0.0f));
    for (const size_t l : lights) {
        if (!glows_[l]) continue;
        glowing.resize(direct.size(), glm::vec3(0.0f));
        for (const uint32_t side : glows_[l]->glow.sides)
            glowing[side] += lights_[l]->onSides[side].visible * emissions_[l];
        for (size_t s = 0; s < byGlow.size(); ++s)
            byGlow[s] += glows_[l]->onFronts[s] * emissions_[l];
    }
    const Bounced bounced = engine_.bounce(albedo, direct, sky, {glowing, byGlow});
    std::vector<glm::vec3> onFronts =
        withoutNoise(texels_.surfels, bounced.irradiance, bounced.noise);
    for (size_t s = 0; s < byGlow.size(); ++s) onFronts[s] += byGlow[s];
    return onFronts;
}

/// A surfel that receives a share of light reflects that share of it.
void RadiosityLight::set(const ActiveLights& active, std::span<const glm::vec3> albedo,
                         ShadowDetail detail, Progress& progress)
{
    findShadows(active, detail, progress);
    const Progress::Stage stage(progress, "bounces");
    emissions_.clear();
    for (const ActiveLight& light : active.lights) emissions_.push_back(light.emission);
    SeenGlows known = std::exchange(glows_, SeenGlows(lights_.size()));
    if (!std::ranges::equal(albedo, glowingAlbedo_)) known.clear();
    glowingAlbedo_.assign(albedo.begin(), albedo.end());

    std::vector<size_t> own;
    std::vector<size_t> others;
    for (size_t l = 0; l < lights_.size(); ++l) (isCorrected(l) ? own : others).push_back(l);
    onFronts_.assign(texels_.surfels.count(), glm::vec3(0.0f));
    std::vector<glm::vec3> indirect = onFronts_;
    if (!own.empty()) {
        const std::vector<glm::vec3> dark(active.sky.size(), glm::vec3(0.0f));
        indirect = corrected(bounced(own, reflectanceBy(albedo, lit_), dark, known), lit_);
        for (const size_t l : own) addDirect(lights_[l]->onFronts, emissions_[l], onFronts_);
        onFronts_ = corrected(onFronts_, lit_);
    }
    if (!others.empty() || !std::ranges::all_of(active.sky, isDark)) {
        const std::vector<glm::vec3> byOthers = bounced(others, albedo, active.sky, known);
        for (size_t s = 0; s < indirect.size(); ++s) indirect[s] += byOthers[s];
        for (const size_t l : others) addDirect(lights_[l]->onFronts, emissions_[l], onFronts_);
    }
    for (size_t s = 0; s < indirect.size(); ++s) onFronts_[s] += indirect[s];
    indirect_ = std::make_shared<const std::vector<glm::vec3>>(std::move(indirect));
}

TexelShading RadiosityLight::shading() const
{
    LightSet own;
    LightSet others;
    for (size_t l = 0; l < lights_.size(); ++l) {
        LightSet& set = isCorrected(l) ? own : others;
        set.lights.push_back(lights_[l]);
        set.emissions.push_back(emissions_[l]);
    }
    const bool isAnyOwn = !own.lights.empty();
    return [&texels = texels_, isAnyOwn, indirect = indirect_,
            byOwn = corrected(texels_, directOf(std::move(own)), lit_),
            byOthers = directOf(std::move(others))](size_t p, size_t begin, const TexelBlock& block,
                                                    ShadingBlock& out) {
        byOthers(p, begin, block, out);
        interpolate(texels, *indirect, p, begin, block, out.indirect);
        if (!isAnyOwn) return;
        ShadingBlock part;
        byOwn(p, begin, block, part);
        add(part.direct, block.count, out.direct);
    };
}

} // namespace relamp
