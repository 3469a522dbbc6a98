#include "output/report.h"

#include "base/file.h"
#include "base/json.h"
#include "relamp/error.h"
#include "relamp/version.h"

#include <cmath>

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

ordered_json scanAsJson(const Scan& scan, const Decomposition& result,
                        const std::filesystem::path& file)
{
    ordered_json pages = ordered_json::array();
    for (const Page& page : scan.pages)
        pages.push_back(
            {{"name", page.name}, {"width", page.image.width}, {"height", page.image.height}});
    return {{"file", file.string()},
            {"triangles", scan.triangleCount()},
            {"meshes", scan.meshes.size()},
            {"pages", std::move(pages)},
            {"texels", result.texelCount()},
            {"squareMetres", std::round(result.area() * 1e3) / 1e3},
            {"extent", toJson(boundsOf(scan).extent())}};
}

ordered_json optionsAsJson(const GatherOptions& gather)
{
    return {{"rays", gather.rays}, {"shadowRays", gather.shadowRays}};
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
    const bool isThesis = options.solver == Solver::thesis;
    ordered_json json = isThesis ? optionsAsJson(options.thesis) : optionsAsJson(options.gather);
    json["solver"] = isThesis ? "thesis" : "gather";
    json["darkest"] = shortest(options.albedo.darkest);
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
    ordered_json fixtures = ordered_json::array();
    for (const Fixture& fixture : result.lights().fixtures)
        fixtures.push_back({{"centre", toJson(fixture.centre)},
                            {"area", shortest(fixture.area)},
                            {"power", toJson(fixture.power())},
                            {"error", toJson(fixture.error)}});
    return {{"fixtures", std::move(fixtures)},
            {"pointLights", result.lights().points.size()},
            {"mergedLights", result.mergedLights().size()},
            {"ambient", toJson(result.lights().ambient)}};
}

} // namespace

std::string reportAsJson(const Scan& scan, const Decomposition& result,
                         const std::filesystem::path& scanFile,
                         const std::vector<std::string>& files, const Progress& progress)
{
    std::vector<std::string> warnings = scan.warnings;
    warnings.insert(warnings.end(), result.warnings().begin(), result.warnings().end());
    const ordered_json report{{"program", std::string("relamp ") + version()},
                              {"scan", scanAsJson(scan, result, scanFile)},
                              {"options", optionsAsJson(result.optionsInForce())},
                              {"seconds", secondsAsJson(progress)},
                              {"lights", lightsAsReport(result)},
                              {"closedLoop",
                               {{"rmsError", shortest(result.closure().rmsError)},
                                {"rmsOfScan", shortest(result.closure().rmsInput)}}},
                              {"warnings", warnings},
                              {"files", files}};
    using Handler = nlohmann::json::error_handler_t;
    return report.dump(1, '\t', false, Handler::replace) + "\n";
}

std::vector<std::string> filesOfFormerReport(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    try {
        const auto bytes = readFile(folder / "report.json", size_t{16} << 20);
        const auto report =
            parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "report.json");
        for (const auto& name : report.value("files", nlohmann::json::array()))
            if (name.is_string() && name.get<std::string>().find('/') == std::string::npos)
                names.push_back(name.get<std::string>());
    } catch (const Error&) { // no report, or not ours: nothing of it is ours to remove
        return {};
    }
    return names;
}

} // namespace relamp
