#include "relamp/delight.h"

#include "albedo/closure.h"
#include "albedo/page_layers.h"
#include "decomposition_state.h"
#include "fit/dials.h"
#include "lights/emitters.h"
#include "lights/expand.shared.h"
#include "lights/fixtures.h"
#include "relamp/error.h"

#include <utility>

namespace relamp
{

namespace
{

EmitterOptions emitterOptions(const ThesisOptions& thesis)
{
    return {.threshold = thesis.emitterThreshold, .expansion = thesis.expansion};
}

/// The scan's own lights; `light` keeps only the emitters that belong to them.
Lights findLights(SurfelLight& light, const Texels& texels, const ThesisOptions& thesis,
                  Progress& progress)
{
    const Progress::Stage stage(progress, "lights");
    Lights lights;
    const int count = joinFixtures(light, texels, emitterOptions(thesis));
    lights.fixtures = fixturesFrom(light.emitters, count);
    lights.points = pointLightsFrom(light.emitters, thesis.lightLevels);
    return lights;
}

/// Colour of all lights together, of luminance 1; white where there is none.
glm::vec3 meanColor(const Lights& lights)
{
    glm::vec3 sum(0.0f);
    for (const PointLight& light : lights.points) sum += light.intensity;
    const float brightness = luminance(sum);
    return brightness > 0.0f ? sum / brightness : glm::vec3(1.0f);
}

/// Sets power and ambient as the options say, or from the scan where they leave them open.
void setDials(ThesisShading& shading, const Texels& texels, const SurfelLight& light,
              const Lights& lights, Progress& progress)
{
    const Progress::Stage stage(progress, "dials");
    ThesisOptions& dials = shading.dials;
    if (!dials.useAmbient) dials.ambient = 0.0f;
    const std::optional<float> power = std::exchange(dials.power, 1.0f); // the samples want it at 1
    const std::vector<glm::vec3> shades = shadingOfSurfels(texels.surfels, shading);
    std::vector<DialSample> samples(shades.size());
    for (size_t s = 0; s < samples.size(); ++s)
        samples[s] = {light.radiance[s], shades[s], light.area[s]};
    const Dials fitted = fitDials(samples, power, dials.ambient);
    dials.power = fitted.power;
    dials.ambient = fitted.ambient;
    const bool asGiven =
        luminance(lights.ambient) > 0.0f && *dials.ambient == luminance(lights.ambient);
    shading.ambient = asGiven ? lights.ambient : *dials.ambient * meanColor(lights);
}

void checkAttenuation(const ThesisOptions& thesis)
{
    if (thesis.attenuation && *thesis.attenuation == glm::vec3(0.0f))
        throw Error(ErrorCode::unsupported,
                    "attenuation 0 0 0 would make every light endless; give one of k0, "
                    "k1, k2 a value");
}

/// Lights of a file are as bright as they say; the dials follow them.
ThesisOptions dialsFor(const Lights& given, const ThesisOptions& thesis)
{
    ThesisOptions dials = thesis;
    if (!dials.power) dials.power = 1.0f;
    if (!dials.ambient) dials.ambient = luminance(given.ambient);
    return dials;
}

void scalePower(Lights& lights, float power, glm::vec3 ambient)
{
    for (Fixture& fixture : lights.fixtures) fixture.radiance *= power;
    for (PointLight& light : lights.points) light.intensity *= power;
    lights.ambient = ambient;
}

std::unique_ptr<Decomposition::State> stateOf(const Scan& scan, Progress& progress)
{
    const Progress::Stage stage(progress, "bvh");
    return std::make_unique<Decomposition::State>(scan);
}

} // namespace

Decomposition delight(const Scan& scan, const DelightOptions& options, Progress& progress)
{
    auto state = stateOf(scan, progress);
    state->texels = rasterizeAtlas(scan, progress);
    checkOverlap(state->texels);
    checkAttenuation(options.thesis);
    SurfelLight light = collectLight(state->texels, emitterOptions(options.thesis), progress);
    const Lights found = findLights(light, state->texels, options.thesis, progress);
    const Lights& lights = options.lights ? *options.lights : found;
    if (lights.points.empty() && !options.lights)
        state->warnings.emplace_back(
            "no light was found: nothing in the texture is burnt out. The result "
            "has ambient light alone; give it lights with --lights");

    const ThesisOptions dials = options.lights ? dialsFor(lights, options.thesis) : options.thesis;
    state->shading = solveThesis(state->texels, state->scene, lights, dials, progress);
    setDials(state->shading, state->texels, light, lights, progress);
    {
        const Progress::Stage stage(progress, "closure");
        state->closure = closeLoop(state->texels, state->scene, light, lights, state->shading,
                                   options.albedo.darkest);
    }

    state->lights = lights;
    scalePower(state->lights, *state->shading.dials.power, state->shading.ambient);
    state->merged = lightsOfShadowMaps(state->lights, state->shading.dials);
    state->shines.assign(state->texels.surfels.count(), 0);
    for (const Emitter& emitter : light.emitters) state->shines[emitter.surfel] = 1;
    state->options = options;
    state->options.thesis = state->shading.dials;
    return Decomposition(std::move(state));
}

Decomposition::Decomposition(std::unique_ptr<State> state) : state_(std::move(state)) {}
Decomposition::~Decomposition() = default;
Decomposition::Decomposition(Decomposition&&) noexcept = default;
Decomposition& Decomposition::operator=(Decomposition&&) noexcept = default;

const Lights& Decomposition::lights() const
{
    return state_->lights;
}

const std::vector<PointLight>& Decomposition::mergedLights() const
{
    return state_->merged;
}

const DelightOptions& Decomposition::optionsInForce() const
{
    return state_->options;
}

const Closure& Decomposition::closure() const
{
    return state_->closure;
}

const std::vector<std::string>& Decomposition::warnings() const
{
    return state_->warnings;
}

size_t Decomposition::texelCount() const
{
    return state_->texels.count();
}

double Decomposition::area() const
{
    return state_->texels.area;
}

const Decomposition::State& Decomposition::state() const
{
    return *state_;
}

PageLayers Decomposition::layers(size_t page, Progress& progress) const
{
    return makeLayers(state_->texels, page, state_->shading, state_->shines, state_->options,
                      progress);
}

} // namespace relamp
