#include "thesis/by_thesis.h"

#include "albedo/divide.shared.h"
#include "albedo/fill.h"
#include "base/radiometry.shared.h"
#include "lights/fixture_labels.h"
#include "relamp/error.h"
#include "thesis/closure.h"
#include "thesis/emitters.h"
#include "thesis/fixtures.h"
#include "thesis/thesis_parameters.h"

#include <memory>
#include <set>
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
    std::vector<std::vector<ClippedPatch>> surfaces(lights.fixtures.size());
    for (const Emitter& emitter : light.emitters)
        surfaces[static_cast<size_t>(emitter.fixture)].push_back(
            {emitter.position, emitter.normal, emitter.area, emitter.surfel});
    const std::vector<FixtureLabel> labels =
        labelsOf(texels, coarsePiecesOf(texels, progress), surfaces, {}, progress);
    for (size_t f = 0; f < labels.size(); ++f) putLabel(labels[f], lights.fixtures[f]);
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
void setParameters(ThesisShading& shading, const Texels& texels, const SurfelLight& light,
                   const Lights& lights, Progress& progress)
{
    const Progress::Stage stage(progress, "parameters");
    ThesisOptions& parameters = shading.parameters;
    if (!parameters.useAmbient) parameters.ambient = 0.0f;
    const std::optional<float> power =
        std::exchange(parameters.power, 1.0f); // the samples want it at 1
    const std::vector<glm::vec3> shades = shadingOfSurfels(texels.surfels, shading);
    std::vector<ParameterSample> samples(shades.size());
    for (size_t s = 0; s < samples.size(); ++s)
        samples[s] = {light.radiance[s], shades[s], light.area[s]};
    const FittedParameters fitted = fitParameters(samples, power, parameters.ambient);
    parameters.power = fitted.power;
    parameters.ambient = fitted.ambient;
    const bool asGiven =
        luminance(lights.ambient) > 0.0f && *parameters.ambient == luminance(lights.ambient);
    shading.ambient = asGiven ? lights.ambient : *parameters.ambient * meanColor(lights);
}

void checkAttenuation(const ThesisOptions& thesis)
{
    if (thesis.attenuation && *thesis.attenuation == glm::vec3(0.0f))
        throw Error(ErrorCode::unsupported,
                    "attenuation 0 0 0 would make every light endless; give one of k0, "
                    "k1, k2 a value");
}

/// Lights of a file are as bright as they say; the parameters follow them.
ThesisOptions parametersFor(const Lights& given, const ThesisOptions& thesis)
{
    ThesisOptions parameters = thesis;
    if (!parameters.power) parameters.power = 1.0f;
    if (!parameters.ambient) parameters.ambient = luminance(given.ambient);
    return parameters;
}

void scalePower(Lights& lights, float power, glm::vec3 ambient)
{
    for (Fixture& fixture : lights.fixtures) fixture.radiance *= power;
    for (PointLight& light : lights.points) light.intensity *= power;
    lights.ambient = ambient;
}

std::vector<glm::vec3> fillOf(const Surfels& surfels, const SurfelLight& light,
                              const ThesisShading& shading, float darkest)
{
    std::vector<glm::vec3> albedo = shadingOfSurfels(surfels, shading);
    std::vector<uint8_t> isKnown(surfels.count());
    for (size_t s = 0; s < albedo.size(); ++s) {
        albedo[s] =
            glm::min(dividedByShading(light.radiance[s], albedo[s], darkest), glm::vec3(1.0f));
        isKnown[s] = light.area[s] > 0.5f * surfels.area[s] ? 1 : 0;
    }
    return fillFromAround(surfels, albedo, isKnown);
}

} // namespace

ThesisSolver::ThesisSolver(const Texels& texels, const RayScene& scene)
    : texels_(texels), scene_(scene), stages_(texels, scene)
{}

const ThesisSolver::Emission& ThesisSolver::emissionOf(const ThesisOptions& thesis,
                                                       Progress& progress)
{
    const std::vector<float> inputs{thesis.emitterThreshold, thesis.expansion,
                                    static_cast<float>(thesis.lightLevels)};
    return emission_.of(inputs, [&] {
        Emission found{collectLight(texels_, emitterOptions(thesis), progress), {}};
        found.lights = findLights(found.light, texels_, thesis, progress);
        return found;
    });
}

Solution ThesisSolver::solve(const DelightOptions& options, Progress& progress)
{
    checkAttenuation(options.thesis);
    Solution solution{.options = options};
    const auto& [light, found] = emissionOf(options.thesis, progress);
    const Lights& lights = options.lights ? *options.lights : found;
    if (lights.points.empty() && !options.lights)
        solution.warnings.emplace_back(
            "no light was found: nothing in the texture is burnt out. The result "
            "has ambient light alone; give it lights with --lights");

    const ThesisOptions parameters =
        options.lights ? parametersFor(lights, options.thesis) : options.thesis;
    const std::shared_ptr<ThesisEngine> engine = engine_.of(
        options.engine, [&] { return std::make_shared<ThesisEngine>(texels_, options.engine); });
    const auto shading =
        std::make_shared<ThesisShading>(engine->solve(stages_, lights, parameters, progress));
    setParameters(*shading, texels_, light, lights, progress);
    {
        const Progress::Stage stage(progress, "closure");
        solution.closure =
            closeLoop(texels_, scene_, light, lights, *shading, options.albedo.darkest);
    }

    if (options.albedo.fill)
        solution.texels.fill = fillOf(texels_.surfels, light, *shading, options.albedo.darkest);
    solution.options.thesis = shading->parameters;
    solution.lights = lights;
    scalePower(solution.lights, *shading->parameters.power, shading->ambient);
    solution.merged = lightsOfShadowMaps(solution.lights, shading->parameters);
    solution.texels.shining = {std::vector<uint8_t>(texels_.surfels.count(), 0),
                               options.thesis.emitterThreshold};
    solution.fixtureOf.assign(texels_.surfels.count(), FixtureMap::kWall);
    std::set<int> named; // of a lights file, only those that it names
    for (const Fixture& fixture : lights.fixtures) named.insert(fixture.id);
    for (const Emitter& emitter : light.emitters) {
        solution.texels.shining.surfels[emitter.surfel] = 1;
        const int number = found.fixtures[static_cast<size_t>(emitter.fixture)].id;
        if (named.contains(number)) solution.fixtureOf[emitter.surfel] = number;
    }
    solution.engine = [engine] { return engine->inForce(); };
    solution.texels.shade = [shading, engine, lights](size_t page, size_t begin,
                                                      const TexelBlock& block, ShadingBlock& out) {
        engine->shadeTexels(*shading, lights, {page, begin}, block, out);
    };
    return solution;
}

} // namespace relamp
