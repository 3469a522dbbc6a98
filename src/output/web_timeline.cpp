#include "output/web_timeline.h"

#include "base/fail.h"
#include "base/radiometry.shared.h"
#include "lights/shining.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

using nlohmann::ordered_json;

constexpr float kApart = 1e-3f; // m, and of a direction: lights further apart are two

[[noreturn]] void refuse(const Timeline& timeline, const std::string& why)
{
    fail(ErrorCode::unsupported, timeline.file().string(),
         why + "; on a page a timeline dims and colours the lights that --lights and --fixture "
               "give, and "
               "that stay in their places");
}

/// How a light sends, all but its strength.
bool isInPlace(const NewLight& a, const NewLight& b)
{
    const auto same = [](glm::vec3 p, glm::vec3 q) { return glm::distance(p, q) < kApart; };
    const bool hasProfiles = a.profile != nullptr && b.profile != nullptr;
    return a.type == b.type && same(a.position, b.position) && same(a.direction, b.direction) &&
           same(a.along, b.along) && glm::distance(a.size, b.size) < kApart &&
           std::abs(a.radius - b.radius) < kApart && std::abs(a.cone - b.cone) < kApart &&
           std::abs(a.blend - b.blend) < kApart && std::abs(a.angle - b.angle) < kApart &&
           (hasProfiles ? a.profile->gain == b.profile->gain : a.profile == b.profile);
}

bool isSameSky(const Sky& a, const Sky& b)
{
    const bool havePictures = a.environment != nullptr && b.environment != nullptr;
    return (havePictures ? a.environment->rgb == b.environment->rgb
                         : a.environment == b.environment) &&
           std::abs(a.turn - b.turn) < kApart;
}

/// One light of a page, wherever it stands in a relighting.
struct Source
{
    bool isOn;      // else it has no lightmap
    glm::vec3 base; // what its lightmap was made of
    std::function<glm::vec3(const Relighting&)> emission;
};

/// All lights of a relighting, in the order in which partsOf() has those that are on.
std::vector<Source> sourcesOf(const Relighting& lighting)
{
    std::vector<Source> sources;
    const auto add = [&](glm::vec3 base, std::function<glm::vec3(const Relighting&)> emission) {
        sources.push_back({!isDark(base), base, std::move(emission)});
    };
    for (size_t i = 0; i < lighting.fixtures.size(); ++i)
        add(lighting.fixtures[i].fixture.radiance,
            [i](const Relighting& now) { return now.fixtures[i].fixture.radiance; });
    for (size_t i = 0; i < lighting.lights.size(); ++i)
        add(lighting.lights[i].emission, [i](const Relighting& now) {
            return now.lights.empty() ? glm::vec3(0.0f) : now.lights[i].emission;
        });
    add(lighting.sky.radiance, [](const Relighting& now) { return now.sky.radiance; });
    return sources;
}

/// Refuses what no mixture of the lightmaps is.
void check(const Timeline& timeline, const Relighting& now, const Relighting& lighting)
{
    const bool hasLights = !now.lights.empty(); // else those of the page are off
    const bool isOfOthers = now.fixtures.size() != lighting.fixtures.size() ||
                            (hasLights && (now.lights.size() != lighting.lights.size() ||
                                           !std::equal(now.lights.begin(), now.lights.end(),
                                                       lighting.lights.begin(), &isInPlace)));
    if (isOfOthers) refuse(timeline, "brings other lights than the page has, or moves one");
    for (size_t i = 0; i < now.fixtures.size(); ++i)
        if (glm::distance(now.fixtures[i].fixture.centre, lighting.fixtures[i].fixture.centre) >
            kApart)
            refuse(timeline, "moves a fixture");
    if (!isDark(now.sky.radiance) && !isSameSky(now.sky, lighting.sky))
        refuse(timeline, "has another sky than the page");
}

/// Times its lightmap. What was not found in a channel cannot be made more.
glm::vec3 weightOf(const Source& source, glm::vec3 now)
{
    const float all = luminance(now) / luminance(source.base);
    glm::vec3 weight(0.0f);
    for (int c = 0; c < 3; ++c) weight[c] = source.base[c] > 0.0f ? now[c] / source.base[c] : all;
    return weight;
}

ordered_json asJson(glm::vec3 weight)
{
    ordered_json list = ordered_json::array();
    for (int c = 0; c < 3; ++c) list.push_back(std::round(1e5 * weight[c]) / 1e5);
    return list;
}

/// Parts of the film between which light changes evenly enough: colour temperatures do not.
std::vector<double> momentsOf(const std::vector<TimelineKey>& keys)
{
    constexpr size_t kMost = 400;
    const size_t steps = std::clamp<size_t>(kMost / keys.size(), 1, 8);
    std::vector<double> moments{0.0};
    for (size_t k = 1; k < keys.size(); ++k)
        for (size_t step = 1; step <= steps; ++step)
            moments.push_back(keys[k - 1].part + (keys[k].part - keys[k - 1].part) *
                                                     static_cast<double>(step) /
                                                     static_cast<double>(steps));
    return moments;
}

} // namespace

ordered_json webTimeline(const Timeline& timeline, const Relighting& lighting)
{
    const std::vector<Source> sources = sourcesOf(lighting);
    const std::vector<TimelineKey> named = timeline.keys();
    const double first = named.front().time;
    const double whole = named.back().time - first;
    ordered_json times = ordered_json::array();
    ordered_json weights = ordered_json::array();
    for (const double moment : momentsOf(named)) {
        times.push_back(first + moment * whole);
        const Relighting now = timeline.at(moment);
        check(timeline, now, lighting);
        ordered_json list = ordered_json::array();
        for (const Source& source : sources) {
            const glm::vec3 emission = source.emission(now);
            if (source.isOn)
                list.push_back(asJson(weightOf(source, emission)));
            else if (!isDark(emission))
                refuse(timeline, "turns on a light that is off on the page");
        }
        weights.push_back(std::move(list));
    }
    ordered_json keys = ordered_json::array();
    for (const TimelineKey& key : named) {
        keys.push_back({{"time", key.time}});
        if (!key.name.empty()) keys.back()["name"] = key.name;
    }
    return {{"seconds", timeline.seconds()},
            {"keys", std::move(keys)},
            {"times", std::move(times)},
            {"weights", std::move(weights)}};
}

} // namespace relamp
