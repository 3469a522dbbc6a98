#include "relight/by_lpv.h"

#include "base/radiometry.shared.h"
#include "thesis/rsm.h"
#include "thesis/thesis_shading.h"

#include <algorithm>
#include <memory>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

/// What one light sends on its first way, times the albedo that it meets.
void addBounce(const Relighter::State& state, const ActiveLight& light,
               const std::vector<Radiance>& albedo, std::vector<BounceLight>& leaving)
{
    const glm::vec3 centre = light.source->centre();
    const PointLight all{.position = centre,
                         .normal = light.isFixture ? light.fixture.normal : light.light.direction,
                         .intensity = light.emission};
    const std::span<const PointLight> one(&all, 1);
    for (BounceLight met :
         reflectiveShadowMaps(state.texels, state.scene, one, state.options.thesis.rsmSize)) {
        const glm::vec3 away = glm::normalize(met.position - centre);
        met.flux *=
            light.source->intensityTowards(away) * glm::min(albedo[met.page][met.pixel], 1.0f);
        leaving.push_back(met);
    }
}

struct LpvLight
{
    std::vector<ActiveLight> lights;
    std::shared_ptr<const Lpv> bounce; // null: no bounce light
    glm::vec3 ambient{0.0f};           // irradiance / pi

    void shade(const TexelBlock& block, ShadingBlock& out) const;
};

void LpvLight::shade(const TexelBlock& block, ShadingBlock& out) const
{
    float* direct[3] = {out.direct.r, out.direct.g, out.direct.b};
    float* indirect[3] = {out.indirect.r, out.indirect.g, out.indirect.b};
    if (bounce) bounce->irradiance(block, out.indirect);
    for (int c = 0; c < 3; ++c) {
        std::fill_n(direct[c], block.count, 0.0f);
        for (size_t i = 0; i < block.count; ++i)
            indirect[c][i] = (bounce ? indirect[c][i] / kPi : 0.0f) + ambient[c];
    }
    float open[TexelBlock::kPadded];
    for (const ActiveLight& light : lights) {
        light.source->open(block, open);
        for (int c = 0; c < 3; ++c)
            for (size_t i = 0; i < block.count; ++i)
                direct[c][i] += open[i] * light.emission[c] / kPi;
    }
}

glm::vec3 meanOf(std::span<const glm::vec3> values)
{
    glm::vec3 sum(0.0f);
    for (const glm::vec3 value : values) sum += value;
    return sum / static_cast<float>(values.size());
}

} // namespace

TexelShading shadingByLpv(const Relighter::State& state, std::vector<std::string>& warnings,
                          Progress& progress)
{
    const ThesisOptions& parameters = state.options.thesis;
    Progress::Stage stage(progress, "bounce", state.active.lights.size() + 1);
    const auto light = std::make_shared<LpvLight>();
    std::vector<Radiance> albedo;
    for (const Image& page : state.painted) albedo.emplace_back(page);
    std::vector<BounceLight> leaving;
    for (const ActiveLight& active : state.active.lights) {
        stage.advance();
        if (active.source->isSun()) {
            warnings.emplace_back("the thesis solver knows no shadows and so no sun: it is left "
                                  "out; use --solver gather");
            continue;
        }
        light->lights.push_back(active);
        if (parameters.useLpv) addBounce(state, active, albedo, leaving);
    }
    if (!leaving.empty()) light->bounce = spread(state.texels, leaving, parameters);
    if (parameters.useAmbient) light->ambient = meanOf(state.active.sky);
    return [light](size_t, size_t, const TexelBlock& block, ShadingBlock& out) {
        light->shade(block, out);
    };
}

} // namespace relamp
