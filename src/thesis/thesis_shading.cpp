#include "thesis/thesis_shading.h"

#include "base/parallel.h"
#include "thesis/fixtures.h"
#include "thesis/rsm.h"
#include "thesis/thesis_shading.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kMergeShareOfRoom = 0.1f; // of the room's diagonal

/// Mean radius of the patches that the lights stand for, weighted by their power.
float meanRadius(const Lights& lights)
{
    float sum = 0.0f;
    float weight = 0.0f;
    for (const PointLight& light : lights.points) {
        const float w = light.intensity.r + light.intensity.g + light.intensity.b;
        sum += w * light.radius;
        weight += w;
    }
    return weight > 0.0f ? sum / weight : 0.0f;
}

std::vector<Blocker> blockersOf(const Surfels& surfels)
{
    std::vector<Blocker> blockers(surfels.count());
    forEachChunk(blockers.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            blockers[s] = {surfels.position[s], surfels.normal[s], surfels.area[s]};
    });
    return blockers;
}

std::vector<float> inputsOfBounce(const Lights& lights, const ThesisOptions& parameters)
{
    std::vector<float> inputs{parameters.flattenReach,
                              parameters.flattenRange,
                              parameters.mergeDistance.value_or(0.0f),
                              static_cast<float>(parameters.rsmSize),
                              static_cast<float>(parameters.lpvSize),
                              static_cast<float>(parameters.lpvSteps)};
    for (const PointLight& light : lights.points)
        for (const glm::vec3 v : {light.position, light.normal, light.intensity,
                                  glm::vec3(light.radius, light.fixture, 0.0f)})
            inputs.insert(inputs.end(), {v.x, v.y, v.z});
    return inputs;
}

} // namespace

void toShading(RgbBlock& block, size_t count, float power, glm::vec3 ambient)
{
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 shading = shadingFrom({block.r[i], block.g[i], block.b[i]}, power, ambient);
        block.r[i] = shading.r;
        block.g[i] = shading.g;
        block.b[i] = shading.b;
    }
}

void shade(const ThesisShading& shading, const TexelBlock& block, ShadingBlock& out)
{
    const float power = shading.parameters.power.value_or(1.0f);
    directIrradiance(block, shading.lights, *shading.parameters.attenuation, out.direct);
    toShading(out.direct, block.count, power, glm::vec3(0.0f));
    if (shading.bounce) {
        shading.bounce->irradiance(block, out.indirect);
        toShading(out.indirect, block.count, power, shading.ambient);
        return;
    }
    float* indirect[3] = {out.indirect.r, out.indirect.g, out.indirect.b};
    for (int c = 0; c < 3; ++c) std::fill_n(indirect[c], block.count, shading.ambient[c]);
}

std::vector<PointLight> lightsOfShadowMaps(const Lights& lights, const ThesisOptions& parameters)
{
    return mergeLights(lights.points, parameters.mergeDistance.value_or(0.0f));
}

ThesisOptions deriveParameters(const ThesisOptions& parameters, const Lights& lights,
                               const Bounds& room)
{
    ThesisOptions derived = parameters;
    // A patch seen from nearer than its own size is no point: k0 keeps it from growing without end.
    const float radius = std::max(meanRadius(lights), 0.01f);
    if (!derived.attenuation) derived.attenuation = glm::vec3(radius * radius, 0.0f, 1.0f);
    if (!derived.mergeDistance)
        derived.mergeDistance = kMergeShareOfRoom * glm::length(room.extent());
    return derived;
}

std::shared_ptr<const Lpv> spread(const Texels& texels, std::span<const BounceLight> leaving,
                                  const ThesisOptions& parameters)
{
    auto lpv = std::make_shared<Lpv>(LpvGrid(boundsOf(*texels.scan), parameters.lpvSize));
    lpv->block(blockersOf(texels.surfels));
    lpv->inject(leaving);
    for (int step = 0; step < parameters.lpvSteps; ++step) lpv->propagate(step == 0);
    lpv->finish();
    return lpv;
}

std::shared_ptr<const Lpv> ThesisStages::bounce(const Lights& lights,
                                                const ThesisOptions& parameters, Progress& progress)
{
    const Flattened& surface =
        flattened_.of({parameters.flattenReach, parameters.flattenRange}, [&] {
            return flatten(texels_, {parameters.flattenReach, parameters.flattenRange}, progress);
        });
    Progress::Stage stage(progress, "bounce", 2);
    std::vector<BounceLight> lit = reflectiveShadowMaps(
        texels_, scene_, lightsOfShadowMaps(lights, parameters), parameters.rsmSize);
    forEachChunk(lit.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) lit[i].flux *= surface.at(lit[i].page, lit[i].pixel);
    });
    stage.advance();
    return spread(texels_, lit, parameters);
}

ThesisShading ThesisStages::solve(const Lights& lights, const ThesisOptions& parameters,
                                  Progress& progress)
{
    ThesisShading shading{.parameters =
                              deriveParameters(parameters, lights, boundsOf(*texels_.scan)),
                          .lights = LightArrays(lights.points)};
    if (!parameters.useLpv || lights.points.empty()) return shading;
    shading.bounce = bounce_.of(inputsOfBounce(lights, shading.parameters),
                                [&] { return bounce(lights, shading.parameters, progress); });
    return shading;
}

ThesisShading solveThesis(const Texels& texels, const RayScene& scene, const Lights& lights,
                          const ThesisOptions& parameters, Progress& progress)
{
    return ThesisStages(texels, scene).solve(lights, parameters, progress);
}

} // namespace relamp
