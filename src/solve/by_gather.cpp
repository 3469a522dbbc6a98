#include "solve/by_gather.h"

#include "base/call_all.h"
#include "relamp/error.h"
#include "solve/find_room.h"
#include "solve/found_lights.h"
#include "solve/room_solution.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

void check(glm::vec3 light, const std::string& what)
{
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(light[c]) || light[c] < 0.0f)
            throw Error(ErrorCode::malformed, what + " must be finite and not negative");
}

/// Throws where these cannot be the room's lights under other powers.
void checkPowers(const Lights& lights, const Lights& ofRoom)
{
    if (lights.fixtures.size() != ofRoom.fixtures.size())
        throw Error(ErrorCode::sizeMismatch,
                    fmt::format("the room has {} fixtures and {} were given; change their radiance "
                                "and leave all else as it is",
                                ofRoom.fixtures.size(), lights.fixtures.size()));
    for (const Fixture& fixture : ofRoom.fixtures) {
        const size_t place = lights.placeOf(fixture.id);
        if (place == lights.fixtures.size())
            throw Error(ErrorCode::sizeMismatch,
                        fmt::format("fixture {} of the room is not among those that were given; "
                                    "change their radiance and leave their id as it is",
                                    fixture.id));
        check(lights.fixtures[place].radiance,
              fmt::format("the radiance of fixture {}", fixture.id));
    }
    check(lights.ambient, "ambient light");
    if (!lights.sun) return;
    if (!ofRoom.sun)
        throw Error(ErrorCode::sizeMismatch,
                    "no sun shines into the room; it has to be solved anew with one");
    check(lights.sun->irradiance, "the sun's irradiance");
}

/// The fixtures that have the numbers of a lamp's labels; all are there.
std::vector<Fixture> namedBy(std::span<const FixtureLabel> labels, const Lights& lights)
{
    std::vector<Fixture> fixtures;
    for (const FixtureLabel& label : labels)
        fixtures.push_back(lights.fixtures[lights.placeOf(label.id)]);
    return fixtures;
}

/// One radiance for a group: the mean by area, or what all have.
glm::vec3 meanOf(std::span<const Fixture> group)
{
    const auto isFirst = [&](const Fixture& f) { return f.radiance == group[0].radiance; };
    if (std::all_of(group.begin(), group.end(), isFirst)) return group[0].radiance;
    glm::vec3 sum(0.0f);
    float area = 0.0f;
    for (const Fixture& fixture : group) {
        sum += fixture.area * fixture.radiance;
        area += fixture.area;
    }
    return sum / area;
}

/// What a person says is known; a lamp that is as it was found is as sure as then.
void setError(FoundLamp& lamp, bool isAsFound, const Fixture& found)
{
    lamp.logError = isAsFound ? found.error : glm::vec3(0.0f);
    lamp.isDetermined = !isAsFound || found.determined;
}

glm::vec3 shareOf(glm::vec3 part, glm::vec3 whole)
{
    glm::vec3 share(1.0f);
    for (int c = 0; c < 3; ++c)
        if (whole[c] > 0.0f) share[c] = part[c] / whole[c];
    return share;
}

} // namespace

bool GatherSolver::isOfKept(const DelightOptions& options) const
{
    return kept_ && !options.lights && !kept_->asked.lights &&
           options.gather == kept_->asked.gather;
}

Solution GatherSolver::solve(const DelightOptions& options, Progress& progress)
{
    if (isOfKept(options)) {
        kept_->asked = options;
        return reevaluate(kept_->found, options.albedo, progress);
    }
    std::shared_ptr<ReevaluateEngine> engine;
    FoundRoom found;
    // The search for a device loads drivers, which takes a while.
    callAll([&] { engine = std::make_shared<ReevaluateEngine>(texels_, options.engine); },
            [&] {
                const FoundRoom* before = kept_ ? &kept_->room.found : nullptr;
                found = findRoom(texels_, scene_, options, progress, before);
            });
    std::optional<Closure> closure;
    {
        const Progress::Stage stage(progress, "shadows");
        SolvedRoom room = solvedRoom(texels_, scene_, std::move(found), [&](const SolvedRoom& lit) {
            if (engine->inForce().engine.engine == Engine::cpu) closure = closureOf(lit);
        });
        keep(std::move(room), options, engine);
    }
    if (!closure) return reevaluate(kept_->found, options.albedo, progress);
    Solution solution = solutionOf(texels_, kept_->room, options, *closure);
    solution.engine = [engine] { return engine->inForce(); };
    return solution;
}

void GatherSolver::keep(SolvedRoom room, const DelightOptions& asked,
                        std::shared_ptr<ReevaluateEngine> engine)
{
    kept_.emplace(KeptRoom{.room = std::move(room), .asked = asked});
    kept_->found = lightsOf(kept_->room.found);
    kept_->powers = kept_->room.found.found.powers;
    kept_->engine.of(asked.engine, [&] { return std::move(engine); });
}

/// Patches of sun that light the room like lamps follow the sun. What is as it was found is so to
/// the bit, which the way to the albedo's scale and back is not.
LampPowers GatherSolver::setPowers(const Lights& lights)
{
    FoundRoom& room = kept_->room.found;
    const Lights& found = kept_->found;
    const Lights given = beforeScale(lights);
    const bool isOneScale = lights.tempering.scale == found.tempering.scale;
    LampPowers powers = kept_->powers;
    if (!isOneScale || lights.ambient != found.ambient)
        powers.outside = {given.ambient, powers.outside.ratios()};
    glm::vec3 share(1.0f);
    if (auto& sun = room.found.sun) {
        sun->sun.irradiance = given.sun ? given.sun->irradiance : glm::vec3(0.0f);
        share = shareOf(sun->sun.irradiance, beforeScale(found).sun->irradiance);
        const bool isAsFound =
            isOneScale && lights.sun && lights.sun->irradiance == found.sun->irradiance;
        if (!isAsFound) powers.lamps.back() = sunRadiance(sun->sun);
    }
    for (size_t l = 0; l < room.found.lamps.size(); ++l) {
        FoundLamp& lamp = room.found.lamps[l];
        if (lamp.isSunlit) {
            powers.lamps[l] *= share;
            continue;
        }
        const Fixture& asFound = found.fixtures[found.placeOf(lamp.labels.front().id)];
        const bool isAsFound =
            isOneScale && meanOf(namedBy(lamp.labels, lights)) == asFound.radiance;
        if (!isAsFound) powers.lamps[l] = meanOf(namedBy(lamp.labels, given));
        setError(lamp, isAsFound, asFound);
    }
    return powers;
}

Solution GatherSolver::reevaluate(const Lights& lights, const AlbedoOptions& albedo,
                                  Progress& progress)
{
    checkPowers(lights, kept_->found);
    Progress::Stage stage(progress, "re-evaluation", 2);
    SolvedRoom& room = kept_->room;
    const LampPowers powers = setPowers(lights);
    room.found.tempering = lights.tempering;
    const auto& engine = kept_->engine.of(kept_->asked.engine, [&] {
        return std::make_shared<ReevaluateEngine>(texels_, kept_->asked.engine);
    });
    DeviceLayers onDevice = engine->reevaluate(room, powers);
    stage.advance();
    const Closure closure = closureOf(room);
    stage.advance();
    DelightOptions options = kept_->asked;
    options.albedo = albedo;
    Solution solution = solutionOf(texels_, room, options, closure);
    solution.onDevice = std::move(onDevice);
    solution.engine = [engine] { return engine->inForce(); };
    return solution;
}

} // namespace relamp
