#include "fit/given_lamps.h"

#include "base/radiometry.shared.h"
#include "lights/shining.h"
#include "shading/sampling.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kMoved = 0.02f;       // m; a fixture that was moved farther is another
constexpr float kOff = 0.25f;         // of its size; it is pointed at by hand
constexpr float kAboutAsLarge = 2.0f; // ratio of areas
constexpr float kFacesAlike = 0.7f;   // of a mean normal, along the fixture's
constexpr float kLeastRadius = 0.02f; // m, of something without a size
constexpr int kPatches = 32;

FixtureLabel labelOf(const Fixture& fixture)
{
    return {fixture.id, fixture.name};
}

glm::vec3 centreOf(std::span<const ClippedPatch> patches)
{
    glm::vec3 sum(0.0f);
    float area = 0.0f;
    for (const ClippedPatch& patch : patches) {
        sum += patch.area * patch.position;
        area += patch.area;
    }
    return sum / area;
}

/// Patches of no surfel.
ClippedPatch patchAt(glm::vec3 position, glm::vec3 normal, float area)
{
    return {position, normal, area, Surfels::kNone};
}

std::vector<ClippedPatch> ball(glm::vec3 centre, float area)
{
    const float radius = std::max(std::sqrt(area / (4.0f * kPi)), kLeastRadius);
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 way = evenDirection(evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        patches.push_back(
            patchAt(centre + radius * way, way, 4.0f * kPi * radius * radius / kPatches));
    }
    return patches;
}

std::vector<ClippedPatch> disc(const Fixture& fixture)
{
    const float radius = std::max(std::sqrt(fixture.area / kPi), kLeastRadius);
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 over =
            cosineDirection(fixture.normal, evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        const glm::vec3 onDisc = over - glm::dot(over, fixture.normal) * fixture.normal;
        patches.push_back(patchAt(fixture.centre + radius * onDisc, fixture.normal,
                                  kPi * radius * radius / kPatches));
    }
    return patches;
}

bool mayBe(const Candidate& candidate, const Fixture& fixture)
{
    const float ratio = candidate.area / fixture.area;
    const bool facesAlike = fixture.normal == glm::vec3(0.0f) ||
                            glm::dot(candidate.normal, fixture.normal) > kFacesAlike;
    return ratio < kAboutAsLarge && ratio > 1.0f / kAboutAsLarge && facesAlike;
}

/// The nearest that the fixture may mean; null without any.
const Candidate* standingAt(const Fixture& fixture, std::span<const Candidate> candidates)
{
    const Candidate* nearest = nullptr;
    float least = kOff * std::sqrt(fixture.area);
    for (const Candidate& candidate : candidates) {
        const float off = glm::distance(candidate.centre, fixture.centre);
        if (off >= least || !mayBe(candidate, fixture)) continue;
        least = off;
        nearest = &candidate;
    }
    return nearest;
}

FoundLamp lampOf(const Fixture& fixture, std::span<const Candidate> candidates)
{
    FoundLamp lamp{{}, fixture.radiance, fixture.error};
    lamp.labels = {labelOf(fixture)};
    if (const Candidate* there = standingAt(fixture, candidates))
        lamp.patches = there->patches;
    else if (fixture.normal != glm::vec3(0.0f))
        lamp.patches = disc(fixture);
    else
        lamp.patches = ball(fixture.centre, fixture.area);
    return lamp;
}

FoundLamp lampOf(const PointLight& light)
{
    const float radius = std::max(light.radius, kLeastRadius);
    return {ball(light.position, 4.0f * kPi * radius * radius),
            light.intensity / (kPi * radius * radius),
            glm::vec3(0.0f),
            {}};
}

/// Lamps that were found, as far as a file still has them there.
class Standing
{
public:
    explicit Standing(const FoundLamps& found) : found_(found) {}

    /// Adds the lamp that stands where the fixture does. Those of a group to which the file gives
    /// one radiance stay together. False where none stands there.
    bool add(const Fixture& fixture, std::vector<FoundLamp>& lamps);

private:
    void addToGroup(size_t group, std::span<const ClippedPatch> single, const Fixture& fixture,
                    std::vector<FoundLamp>& lamps);

    const FoundLamps& found_;
    std::map<std::array<float, 4>, size_t> placed_; // group and radiance: index in `lamps`
    std::set<const ClippedPatch*> taken_;           // first of each lamp of a group that was added
};

void Standing::addToGroup(size_t group, std::span<const ClippedPatch> single,
                          const Fixture& fixture, std::vector<FoundLamp>& lamps)
{
    const glm::vec3 light = fixture.radiance;
    const auto [place, isNew] =
        placed_.try_emplace({static_cast<float>(group), light.r, light.g, light.b}, lamps.size());
    if (isNew) lamps.push_back({{}, light, fixture.error});
    FoundLamp& kept = lamps[place->second];
    kept.labels.push_back(labelOf(fixture));
    kept.patches.insert(kept.patches.end(), single.begin(), single.end());
    kept.ends.push_back(static_cast<uint32_t>(kept.patches.size()));
    if (kept.ends.size() == found_.lamps[group].ends.size())
        kept.onSides = found_.lamps[group].onSides;
}

bool Standing::add(const Fixture& fixture, std::vector<FoundLamp>& lamps)
{
    for (size_t f = 0; f < found_.lamps.size(); ++f) {
        const FoundLamp& lamp = found_.lamps[f];
        for (const auto& single : singlesOf(lamp)) {
            if (glm::distance(centreOf(single), fixture.centre) >= kMoved) continue;
            if (lamp.ends.empty() || !taken_.insert(single.data()).second) {
                lamps.push_back({{single.begin(), single.end()}, fixture.radiance, fixture.error});
                lamps.back().labels = {labelOf(fixture)};
                if (lamp.ends.empty()) lamps.back().onSides = lamp.onSides;
            } else {
                addToGroup(f, single, fixture, lamps);
            }
            return true;
        }
    }
    return false;
}

} // namespace

FoundLamps asGiven(const Lights& given, const FoundLamps& found,
                   std::span<const Candidate> candidates)
{
    FoundLamps lamps;
    lamps.ambient = given.ambient;
    Standing standing(found);
    for (const Fixture& fixture : given.fixtures)
        if (!isDark(fixture.radiance) && !standing.add(fixture, lamps.lamps))
            lamps.lamps.push_back(lampOf(fixture, candidates));
    for (const PointLight& light : given.points)
        if (light.fixture < 0 && !isDark(light.intensity)) lamps.lamps.push_back(lampOf(light));
    return lamps;
}

} // namespace relamp
