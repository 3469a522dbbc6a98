#include "output/report.h"

#include "base/json.h"
#include "base/radiometry.shared.h"
#include "decomposition_state.h"
#include "lights/camera_item.h"
#include "relamp/names.h"
#include "relamp/version.h"
#include "relight/photometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace relamp
{
namespace
{

using nlohmann::ordered_json;

ordered_json toJson(glm::vec3 v)
{
    return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

double toMillisecond(double seconds)
{
    return std::round(seconds * 1e3) / 1e3;
}

/// The way to the scan from the folder of its result, so that both can be moved together, and what
/// tells it from other files.
ordered_json sourceAsJson(const Written& written)
{
    std::error_code failure;
    // Of a folder that is not there yet, only an absolute name is made canonical.
    const auto folder = std::filesystem::absolute(written.folder, failure);
    const auto way = std::filesystem::relative(written.scanFile, folder, failure);
    ordered_json source{{"file", (way.empty() ? written.scanFile : way).generic_string()}};
    if (std::filesystem::is_regular_file(written.scanFile, failure))
        source.update(asJson(markOf(written.scanFile)));
    return source;
}

ordered_json scanAsJson(const Scan& scan, const Decomposition& result, const Written& written)
{
    ordered_json pages = ordered_json::array();
    for (const Page& page : scan.pages)
        pages.push_back(
            {{"name", page.name}, {"width", page.image.width}, {"height", page.image.height}});
    ordered_json json = sourceAsJson(written);
    json.update({{"up", nameOf(scan.options.up)},
                 {"scale", scan.options.scale},
                 {"transfer", nameOf(scan.options.transfer)},
                 {"longestSide", scan.options.longestSide},
                 {"gltf", scan.gltf != nullptr},
                 {"skippedMeshes", scan.options.skipMeshes},
                 {"allowOverlap", scan.options.allowOverlap},
                 {"triangles", scan.triangleCount()},
                 {"meshes", scan.meshes.size()},
                 {"pages", std::move(pages)},
                 {"texels", result.texelCount()},
                 {"overlapShare", std::round(result.state().texels->overlap.share() * 1e4) / 1e4},
                 {"squareMetres", std::round(result.area() * 1e3) / 1e3},
                 {"extent", toJson(boundsOf(scan).extent())}});
    return json;
}

ordered_json placesAsJson(const std::vector<glm::vec3>& places)
{
    ordered_json list = ordered_json::array();
    for (const glm::vec3 place : places) list.push_back(toJson(place));
    return list;
}

ordered_json pairsAsJson(const std::vector<SamePaint>& same)
{
    ordered_json list = ordered_json::array();
    for (const auto& [a, b] : same) list.push_back(placesAsJson({a, b}));
    return list;
}

/// Null where it is looked for.
ordered_json responseAsJson(const std::optional<Response>& response)
{
    ordered_json slopes;
    if (response)
        for (const float slope : response->slope) slopes.push_back(shortest(slope));
    return slopes;
}

ordered_json optionsAsJson(const GatherOptions& gather)
{
    return {{"quality", nameOf(gather.quality)},
            {"rays", gather.rays},
            {"shadowRays", gather.shadowRays},
            {"lights", placesAsJson(gather.lights)},
            {"notLights", placesAsJson(gather.notLights)},
            {"same", pairsAsJson(gather.same)},
            {"white", placesAsJson(gather.white)},
            {"sun", gather.sun},
            {"response", responseAsJson(gather.response)},
            {"gain", gather.gain},
            {"raySeed", gather.seed}};
}

ordered_json optionsOfPathtrace(const DelightOptions& options)
{
    ordered_json json = optionsAsJson(options.gather);
    json["samples"] = options.pathtrace.samples;
    json["seed"] = options.pathtrace.seed;
    return json;
}

ordered_json optionsAsJson(const ThesisOptions& thesis)
{
    return {{"emitterThreshold", shortest(thesis.emitterThreshold)},
            {"expansion", shortest(thesis.expansion)},
            {"lightLevels", thesis.lightLevels},
            {"attenuation", toJson(*thesis.attenuation)},
            {"power", shortest(*thesis.power)},
            {"ambient", shortest(*thesis.ambient)},
            {"mergeDistance", shortest(*thesis.mergeDistance)},
            {"rsmSize", thesis.rsmSize},
            {"lpvSize", thesis.lpvSize},
            {"lpvSteps", thesis.lpvSteps},
            {"flattenReach", shortest(thesis.flattenReach)},
            {"flattenRange", shortest(thesis.flattenRange)},
            {"lpv", thesis.useLpv},
            {"ambientLight", thesis.useAmbient}};
}

ordered_json optionsAsJson(const DelightOptions& options)
{
    ordered_json json = options.solver == Solver::thesis      ? optionsAsJson(options.thesis)
                        : options.solver == Solver::pathtrace ? optionsOfPathtrace(options)
                                                              : optionsAsJson(options.gather);
    json["solver"] = nameOf(options.solver);
    if (options.solver != Solver::pathtrace) json["engine"] = options.engine.gpu;
    json["darkest"] = shortest(options.albedo.darkest);
    json["fill"] = options.albedo.fill;
    json["lightsFromFile"] = options.lights.has_value();
    return json;
}

/// All stages, and the three rows of the thesis's table 1.
ordered_json secondsAsJson(const Progress& progress)
{
    ordered_json stages = ordered_json::object();
    double bilateral = 0.0;
    double inverse = 0.0;
    for (const auto& [stage, seconds] : progress.times()) {
        stages[stage] = toMillisecond(seconds);
        if (stage == "flatten") bilateral += seconds;
        if (stage == "bounce" || stage == "divide") inverse += seconds;
    }
    return {{"stages", std::move(stages)},
            {"bilateral", toMillisecond(bilateral)},
            {"inverseRendering", toMillisecond(inverse)},
            {"total", toMillisecond(progress.elapsed())}};
}

ordered_json lightsAsReport(const Decomposition& result)
{
    const PhotometricWhite white;
    ordered_json fixtures = ordered_json::array();
    const Lights& lights = result.lights();
    for (size_t i = 0; i < lights.fixtures.size(); ++i) {
        const Fixture& fixture = lights.fixtures[i];
        fixtures.push_back({{"id", lights.idOf(i)},
                            {"name", lights.nameOf(i)},
                            {"centre", toJson(fixture.centre)},
                            {"area", shortest(fixture.area)},
                            {"power", toJson(fixture.power())},
                            {"lumens", shortest(white.luminance * luminance(fixture.power()))},
                            {"error", toJson(fixture.error)},
                            {"determined", fixture.determined}});
    }
    ordered_json json{{"white", {{"nits", white.luminance}}},
                      {"fixtures", std::move(fixtures)},
                      {"pointLights", result.lights().points.size()},
                      {"mergedLights", result.mergedLights().size()},
                      {"ambient", toJson(result.lights().ambient)}};
    json["openings"] = ordered_json::array();
    for (const Opening& opening : result.openings())
        json["openings"].push_back({{"centre", toJson(opening.centre)},
                                    {"normal", toJson(opening.normal)},
                                    {"area", shortest(opening.area)},
                                    {"radiance", toJson(opening.radiance)}});
    if (const auto& sun = result.lights().sun)
        json["sun"] = {{"direction", toJson(sun->direction)},
                       {"irradiance", toJson(sun->irradiance)},
                       {"error", toJson(sun->error)},
                       {"determined", sun->determined}};
    json["camera"] = {{"contrast", shortest(lights.camera.response.contrast())},
                      {"localExponent", shortest(lights.camera.tone.exponent)},
                      {"gainStops", shortest(lights.camera.stops())},
                      {"drifted", shortest(lights.camera.drifted)},
                      {"model", cameraAsJson(lights.camera)}};
    return json;
}

/// Stops; null where nothing was measured.
ordered_json crossValidationAsJson(const CrossValidation& validation)
{
    if (validation.pairs == 0) return nullptr;
    return {{"pairs", validation.pairs},
            {"scan", shortest(validation.scan)},
            {"albedo", shortest(validation.albedo)},
            {"gainDb", shortest(validation.gain())},
            {"chromaOfScan", shortest(validation.chromaOfScan)},
            {"chromaOfAlbedo", shortest(validation.chromaOfAlbedo)},
            {"shadingPower", shortest(validation.shadingPower)},
            {"improves", validation.improves}};
}

/// Shares of the area.
ordered_json confidenceAsJson(const std::array<double, kDoubts>& area)
{
    const double all = std::max(std::accumulate(area.begin(), area.end(), 0.0), 1e-30);
    const auto share = [&](double part) { return std::round(part / all * 1e4) / 1e4; };
    ordered_json low = ordered_json::object();
    for (size_t d = 1; d < kDoubts; ++d) low[nameOf(static_cast<Doubt>(d))] = share(area[d]);
    return {{"good", share(area[0])}, {"low", std::move(low)}};
}

} // namespace

std::string reportAsJson(const Decomposition& result, const Written& written,
                         const Progress& progress)
{
    const Scan& scan = *result.scan();
    std::vector<std::string> warnings = scan.warnings;
    const std::vector<std::string> ofResult = result.warnings();
    warnings.insert(warnings.end(), ofResult.begin(), ofResult.end());
    const ordered_json report{{"program", std::string("relamp ") + version()},
                              {"scan", scanAsJson(scan, result, written)},
                              {"options", optionsAsJson(result.optionsInForce())},
                              {"seconds", secondsAsJson(progress)},
                              {"lights", lightsAsReport(result)},
                              {"closedLoop",
                               {{"rmsError", shortest(result.closure().rmsError)},
                                {"rmsOfScan", shortest(result.closure().rmsInput)}}},
                              {"crossValidation", crossValidationAsJson(result.crossValidation())},
                              {"confidence", confidenceAsJson(written.area)},
                              {"warnings", warnings},
                              {"files", written.files.asJson()}};
    return textOf(report);
}

} // namespace relamp
