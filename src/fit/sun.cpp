#include "fit/sun.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "lights/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kFar = 1e4f;           // m; a room's size beside it is nothing
constexpr float kHalfAngle = 0.00465f; // radians of the disc
constexpr int kPatchesOfDisc = 32;
constexpr float kOffScan = 0.02f;      // m; a scan's error
constexpr float kGrazing = 0.15f;      // cosine; below, an edge is too far off
constexpr float kLeastHeight = 0.03f;  // of the direction; the sun is up
constexpr float kOneSidedSun = 0.7f;   // of sunlight on a floor and a chair; half a shade has 0.64
constexpr float kLeastPatch = 0.03f;   // m^2
constexpr float kWhitePaper = 0.75f;   // albedo
constexpr float kExplainedWall = 0.5f; // radiance that lamps would give a burnt-out wall
constexpr float kLeastFronts = 0.3f;   // of what is seen from within a room
constexpr float kTooBright = 1.3f;     // albedo that nothing has
constexpr float kPaper = 0.95f;        // albedo up to which light is as thought
constexpr float kLeastSunlit = 0.25f;  // radiance
constexpr size_t kMostPatches = 8;
constexpr size_t kDirections = 4096; // over the sphere
constexpr size_t kFinalists = 6;
constexpr float kSeesOut = 0.6f;   // share of a patch's area, at the first look
constexpr float kStandsOut = 0.4f; // beyond the share of what lies around
constexpr float kFits = 0.6f;      // of the union of lit and predicted
constexpr float kMostSeesOut = 0.8f;
constexpr float kFirstStep = 0.03f; // radians
constexpr float kLastStep = 0.001f;
constexpr float kBlackest = 0.08f; // albedo of what the sun may shine on
constexpr float kHardlyClipped = 0.1f;
constexpr float kSunlitPlaneFacing = 0.97f; // cosine
constexpr float kSamePlane = 0.05f;         // m
constexpr float kLeastShade = 0.02f;        // albedo of what pairs with the patch
constexpr float kLeastWayToSun = 0.1f;      // m; nearer does not count more
constexpr float kDisagree = 0.5f;           // of the irradiance; what is so far apart tells little
constexpr size_t kFewSites = 20;            // that tell little

/// What the light that is known makes of a surfel.
enum class Look : uint8_t { other, dark, bright };

/// What tells how bright the sun is on a bright surfel, the better first: what the texture shows;
/// what it was fitted with as a lamp, for its bounce lights the room like one; no less than white.
enum class Evidence : uint8_t { plain, lamp, white };
constexpr size_t kEvidences = 3;

/// A surfel that stands for an area.
struct Site
{
    uint32_t surfel;
    float weight; // m^2
};

/// Some of many, evenly, that stand for all.
std::vector<Site> someOf(const Surfels& surfels, std::span<const uint32_t> all, size_t most)
{
    float area = 0.0f;
    for (const uint32_t s : all) area += surfels.area[s];
    std::vector<Site> sites;
    float chosen = 0.0f;
    const size_t count = std::min(most, all.size());
    for (size_t i = 0; i < count; ++i) {
        const uint32_t s = all[i * all.size() / count];
        sites.push_back({s, surfels.area[s]});
        chosen += surfels.area[s];
    }
    for (Site& site : sites) site.weight *= area / std::max(chosen, 1e-9f);
    return sites;
}

float areaOf(std::span<const Site> sites)
{
    float area = 0.0f;
    for (const Site& site : sites) area += site.weight;
    return area;
}

/// A piece of surface that is brighter than known light makes it, and what is not.
struct Patch
{
    std::vector<uint32_t> surfels;
    std::vector<uint32_t> around; // dark, near it
    std::vector<uint32_t> beyond; // dark, elsewhere
    std::vector<uint32_t> others; // bright, elsewhere
    float area = 0.0f;
    glm::vec3 centre{0.0f};
};

/// Places of a patch and of what is dark, from which to look for the sun.
struct View
{
    std::vector<Site> patch;
    std::vector<Site> around;
    std::vector<Site> beyond;
    std::vector<Site> others;

    View(const Surfels& surfels, const Patch& of, size_t sites)
        : patch(someOf(surfels, of.surfels, sites)), around(someOf(surfels, of.around, sites)),
          beyond(someOf(surfels, of.beyond, 2 * sites)), others(someOf(surfels, of.others, sites))
    {}
};

/// How well a direction tells a patch from the rest.
struct Match
{
    float score = 0.0f;   // area lit and predicted, of the area that is either; what is lit
                          // elsewhere counts where it is predicted
    float seesOut = 0.0f; // share of the patch
};

class SunSearch
{
public:
    SunSearch(const Texels& texels, const RayScene& outside, const HitLists& hits,
              const SurfelRadiance& radiance, const LitSides& sides, const FoundLamps& found);

    [[nodiscard]] std::optional<Sun> run() const;

private:
    [[nodiscard]] Look lookOf(uint32_t s) const;
    [[nodiscard]] std::vector<Patch> patches() const;
    void addSurroundings(Patch& patch) const;
    /// None where the surfel looks away.
    [[nodiscard]] std::optional<Ray> rayOut(uint32_t surfel, glm::vec3 direction) const;
    [[nodiscard]] bool seesOut(uint32_t surfel, glm::vec3 direction) const;
    [[nodiscard]] float areaSeeingOut(std::span<const Site> sites, glm::vec3 direction) const;
    [[nodiscard]] Match matchOf(const View& view, glm::vec3 direction) const;
    [[nodiscard]] std::vector<glm::vec3> finalists(const Patch& patch) const;
    [[nodiscard]] std::pair<glm::vec3, Match> refined(const Patch& patch, glm::vec3 start) const;
    [[nodiscard]] Evidence evidenceOf(uint32_t s) const;
    [[nodiscard]] Evidence evidenceOf(const Patch& patch) const;
    [[nodiscard]] glm::vec3 sentBy(uint32_t s) const;
    [[nodiscard]] std::optional<glm::vec3> albedoBeside(uint32_t s,
                                                        std::span<const Site> shade) const;
    [[nodiscard]] Sun measured(std::span<const Patch> patches, glm::vec3 direction) const;
    [[nodiscard]] glm::vec3 irradianceOn(uint32_t s) const;

    const Surfels& surfels_;
    const RayScene& outside_;
    const SurfelRadiance& radiance_;
    const LitSides& sides_;
    const FoundLamps& found_;
    std::vector<int32_t> lamp_; // of surfels; -1 for none
    std::vector<Look> look_;
};

/// Whether it hardly sees a front: a sofa's end that stands through the wall is in nobody's room.
bool isOutdoors(const HitLists& hits, uint32_t s)
{
    const std::span<const HitTarget> targets = hits.targetsOf(s);
    const auto fronts = std::count_if(targets.begin(), targets.end(), [](HitTarget target) {
        return !target.isNothing() && !target.side().isBack();
    });
    return static_cast<float>(fronts) < kLeastFronts * static_cast<float>(targets.size());
}

SunSearch::SunSearch(const Texels& texels, const RayScene& outside, const HitLists& hits,
                     const SurfelRadiance& radiance, const LitSides& sides, const FoundLamps& found)
    : surfels_(texels.surfels), outside_(outside), radiance_(radiance), sides_(sides),
      found_(found), lamp_(texels.surfels.count(), -1), look_(texels.surfels.count())
{
    std::vector<uint8_t> isRound(found.lamps.size(), 0);
    for (size_t f = 0; f < found.lamps.size(); ++f) {
        isRound[f] = glm::length(candidateOf(found.lamps[f].patches).normal) < kOneSidedSun ? 1 : 0;
        for (const ClippedPatch& patch : found.lamps[f].patches)
            if (patch.surfel != Surfels::kNone) lamp_[patch.surfel] = static_cast<int32_t>(f);
    }
    for (uint32_t s = 0; s < look_.size(); ++s) {
        const bool isOfRound = lamp_[s] >= 0 && isRound[static_cast<size_t>(lamp_[s])] != 0;
        look_[s] = isOfRound || isOutdoors(hits, s) ? Look::other : lookOf(s);
    }
}

glm::vec3 SunSearch::irradianceOn(uint32_t s) const
{
    return sides_.direct[s] + sides_.gathered.irradiance[s];
}

Look SunSearch::lookOf(uint32_t s) const
{
    const float shading = luminance(irradianceOn(s)) / kPi;
    const float clipped = radiance_.clippedArea[s];
    const float plain = radiance_.plainArea[s];
    if (clipped > plain) {
        if (lamp_[s] >= 0) return Look::bright;
        return kWhitePaper * shading < kExplainedWall ? Look::bright : Look::other;
    }
    if (clipped > kHardlyClipped * plain) return Look::other;
    const float seen = luminance(radiance_.plain[s]);
    if (seen > kTooBright * shading) return seen > kLeastSunlit ? Look::bright : Look::other;
    return seen < kPaper * shading ? Look::dark : Look::other;
}

std::vector<Patch> SunSearch::patches() const
{
    DisjointSets sets(surfels_.count());
    for (uint32_t s = 0; s < look_.size(); ++s)
        for (const uint32_t n : surfels_.neighborsOf(s))
            if (look_[s] == Look::bright && look_[n] == Look::bright && lamp_[s] == lamp_[n])
                sets.join(s, n);
    std::map<uint32_t, Patch> bySet;
    for (uint32_t s = 0; s < look_.size(); ++s) {
        if (look_[s] != Look::bright) continue;
        Patch& patch = bySet[sets.find(s)];
        patch.surfels.push_back(s);
        patch.area += surfels_.area[s];
        patch.centre += surfels_.area[s] * surfels_.position[s];
    }
    std::vector<Patch> patches;
    for (auto& [set, patch] : bySet) {
        if (patch.area < kLeastPatch) continue;
        patch.centre /= patch.area;
        patches.push_back(std::move(patch));
    }
    std::stable_sort(patches.begin(), patches.end(),
                     [](const Patch& a, const Patch& b) { return a.area > b.area; });
    if (patches.size() > kMostPatches) patches.resize(kMostPatches);
    for (Patch& patch : patches) addSurroundings(patch);
    return patches;
}

void SunSearch::addSurroundings(Patch& patch) const
{
    float radius = 0.0f;
    for (const uint32_t s : patch.surfels)
        radius = std::max(radius, glm::distance(surfels_.position[s], patch.centre));
    const float near = 1.5f * radius + 0.3f;
    std::vector<uint32_t> bright;
    for (uint32_t s = 0; s < look_.size(); ++s) {
        if (look_[s] == Look::bright) bright.push_back(s);
        if (look_[s] != Look::dark) continue;
        const bool isNear = glm::distance(surfels_.position[s], patch.centre) < near;
        (isNear ? patch.around : patch.beyond).push_back(s);
    }
    std::set_difference(bright.begin(), bright.end(), patch.surfels.begin(), patch.surfels.end(),
                        std::back_inserter(patch.others)); // both ascend
}

std::optional<Ray> SunSearch::rayOut(uint32_t s, glm::vec3 direction) const
{
    if (glm::dot(surfels_.normal[s], direction) < kGrazing) return std::nullopt;
    return Ray{surfels_.position[s] + kOffScan * surfels_.normal[s], direction};
}

bool SunSearch::seesOut(uint32_t s, glm::vec3 direction) const
{
    const std::optional<Ray> ray = rayOut(s, direction);
    return ray && !outside_.occluded(*ray);
}

/// Rays of one direction from places side by side are traced together.
float SunSearch::areaSeeingOut(std::span<const Site> sites, glm::vec3 direction) const
{
    std::vector<Ray> rays;
    std::vector<float> weights;
    for (const Site& site : sites)
        if (const std::optional<Ray> ray = rayOut(site.surfel, direction)) {
            rays.push_back(*ray);
            weights.push_back(site.weight);
        }
    std::vector<uint8_t> blocked(rays.size());
    outside_.occluded(rays, blocked);
    float area = 0.0f;
    for (size_t i = 0; i < rays.size(); ++i)
        if (blocked[i] == 0) area += weights[i];
    return area;
}

Match SunSearch::matchOf(const View& view, glm::vec3 direction) const
{
    Match match;
    const float lit = areaSeeingOut(view.patch, direction);
    match.seesOut = lit / areaOf(view.patch);
    if (match.seesOut < kSeesOut) return match;
    const float near = areaSeeingOut(view.around, direction);
    const float stands = match.seesOut - near / std::max(areaOf(view.around), 1e-9f);
    if (stands < kStandsOut) return match;
    const float others = areaSeeingOut(view.others, direction);
    match.score = (lit + others) /
                  (areaOf(view.patch) + others + near + areaSeeingOut(view.beyond, direction));
    return match;
}

/// Directions, evenly over the sky, that a look from a few places does not rule out.
std::vector<glm::vec3> SunSearch::finalists(const Patch& patch) const
{
    const View view(surfels_, patch, 24);
    std::vector<std::pair<float, size_t>> ranked(kDirections, {0.0f, 0});
    const auto directionOf = [](size_t i) {
        return evenDirection(evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
    };
    forEachChunk(kDirections, 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 direction = directionOf(i);
            if (direction.y < kLeastHeight) continue;
            ranked[i] = {matchOf(view, direction).score, i};
        }
    });
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<glm::vec3> best;
    for (size_t k = 0; k < kFinalists && ranked[k].first > 0.0f; ++k)
        best.push_back(directionOf(ranked[k].second));
    return best;
}

/// Climbs to the best direction around.
std::pair<glm::vec3, Match> SunSearch::refined(const Patch& patch, glm::vec3 start) const
{
    const View view(surfels_, patch, 800);
    std::pair<glm::vec3, Match> best{start, matchOf(view, start)};
    for (float step = kFirstStep; step > kLastStep;) {
        const glm::vec3 side = glm::normalize(glm::cross(
            best.first, std::abs(best.first.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
        const glm::vec3 up = glm::cross(side, best.first);
        std::array<std::pair<glm::vec3, Match>, 8> tries;
        forEach(tries.size(), [&](size_t k) {
            const float angle = static_cast<float>(k) * kPi / 4.0f;
            const glm::vec3 direction =
                glm::normalize(best.first + step * (std::cos(angle) * side + std::sin(angle) * up));
            tries[k] = {direction, matchOf(view, direction)};
        });
        const auto& most =
            *std::max_element(tries.begin(), tries.end(), [](const auto& a, const auto& b) {
                return a.second.score < b.second.score;
            });
        if (most.second.score > best.second.score && most.first.y > kLeastHeight)
            best = most;
        else
            step *= 0.5f;
    }
    return best;
}

Evidence SunSearch::evidenceOf(uint32_t s) const
{
    if (radiance_.plainArea[s] > radiance_.clippedArea[s]) return Evidence::plain;
    return lamp_[s] >= 0 ? Evidence::lamp : Evidence::white;
}

/// What most of its surfels are.
Evidence SunSearch::evidenceOf(const Patch& patch) const
{
    std::array<float, kEvidences> area{};
    for (const uint32_t s : patch.surfels)
        area[static_cast<size_t>(evidenceOf(s))] += surfels_.area[s];
    return static_cast<Evidence>(std::max_element(area.begin(), area.end()) - area.begin());
}

glm::vec3 SunSearch::sentBy(uint32_t s) const
{
    switch (evidenceOf(s)) {
    case Evidence::plain:
        return radiance_.plain[s];
    case Evidence::lamp:
        return found_.lamps[static_cast<size_t>(lamp_[s])].radiance;
    case Evidence::white:
        break;
    }
    return glm::vec3(1.0f);
}

/// Albedo of what lies in the shade on the same plane, what is near above all.
std::optional<glm::vec3> SunSearch::albedoBeside(uint32_t s, std::span<const Site> shade) const
{
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (const Site& other : shade) {
        const uint32_t n = other.surfel;
        const glm::vec3 way = surfels_.position[n] - surfels_.position[s];
        if (glm::dot(surfels_.normal[n], surfels_.normal[s]) < kSunlitPlaneFacing ||
            std::abs(glm::dot(way, surfels_.normal[s])) > kSamePlane)
            continue;
        const float weight = 1.0f / (glm::dot(way, way) + kLeastWayToSun * kLeastWayToSun);
        sum += weight * sides_.albedo[n];
        weights += weight;
    }
    if (weights == 0.0f) return std::nullopt;
    return sum / weights;
}

/// What most values of each channel are about, with half the distance of their quartiles.
Sun middleOf(std::array<std::vector<float>, 3>& wanted)
{
    Sun sun;
    for (int c = 0; c < 3; ++c) {
        std::vector<float>& values = wanted[static_cast<size_t>(c)];
        if (values.empty()) continue;
        std::sort(values.begin(), values.end());
        sun.irradiance[c] = std::max(values[values.size() / 2], 0.0f);
        const float spread = values[3 * values.size() / 4] - values[values.size() / 4];
        sun.error[c] = 0.5f * spread / std::max(sun.irradiance[c], 1e-6f);
    }
    return sun;
}

/// Irradiance by pairs of one plane: what the sun must add where it shines, for patches to have the
/// albedo of what lies around them. Of all patches, for one alone may lie between unlike paints.
Sun SunSearch::measured(std::span<const Patch> patches, glm::vec3 direction) const
{
    constexpr size_t kSites = 300;
    std::array<std::array<std::vector<float>, 3>, kEvidences> wanted;
    for (const Patch& patch : patches) {
        const Evidence evidence = evidenceOf(patch);
        const std::vector<Site> shade = someOf(surfels_, patch.around, kSites);
        for (const Site& site : someOf(surfels_, patch.surfels, kSites)) {
            const uint32_t s = site.surfel;
            if (evidenceOf(s) != evidence || !seesOut(s, direction)) continue;
            const std::optional<glm::vec3> albedo = albedoBeside(s, shade);
            if (!albedo) continue;
            const glm::vec3 whole =
                kPi * sentBy(s) / glm::max(*albedo, glm::vec3(kLeastShade)) - irradianceOn(s);
            for (int c = 0; c < 3; ++c)
                wanted[static_cast<size_t>(evidence)][static_cast<size_t>(c)].push_back(
                    whole[c] / glm::dot(surfels_.normal[s], direction));
        }
    }
    std::optional<Sun> doubtful;
    for (const Evidence evidence : {Evidence::plain, Evidence::lamp, Evidence::white}) {
        auto& values = wanted[static_cast<size_t>(evidence)];
        if (values[0].size() < kFewSites) continue;
        Sun sun = middleOf(values);
        sun.direction = direction;
        sun.determined = evidence != Evidence::white;
        if (!sun.determined || luminance(sun.error) < kDisagree) return sun;
        if (!doubtful) doubtful = sun;
    }
    return doubtful.value_or(Sun{.direction = direction});
}

std::optional<Sun> SunSearch::run() const
{
    const std::vector<Patch> all = patches();
    std::optional<Sun> best;
    float most = kFits;
    for (const Patch& patch : all)
        for (const glm::vec3 start : finalists(patch)) {
            const auto [direction, match] = refined(patch, start);
            if (match.score <= most || match.seesOut < kMostSeesOut) continue;
            const Sun sun = measured(all, direction);
            if (luminance(sun.irradiance) <= 0.0f) continue;
            best = sun;
            most = match.score;
        }
    return best;
}

} // namespace

std::vector<ClippedPatch> sunDisc(const Sun& sun, const Scan& scan)
{
    const glm::vec3 centre = boundsOf(scan).centre() + kFar * sun.direction;
    const float radius = kFar * kHalfAngle;
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatchesOfDisc; ++i) {
        const glm::vec3 over =
            cosineDirection(sun.direction, evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        const glm::vec3 onDisc = over - glm::dot(over, sun.direction) * sun.direction;
        patches.push_back({centre + radius * onDisc, -sun.direction,
                           kPi * radius * radius / kPatchesOfDisc, Surfels::kNone});
    }
    return patches;
}

glm::vec3 sunRadiance(const Sun& sun)
{
    return sun.irradiance / (kPi * kHalfAngle * kHalfAngle);
}

std::optional<Sun> findSun(const Texels& texels, const RayScene& outside, const HitLists& hits,
                           const SurfelRadiance& radiance, const LitSides& sides,
                           const FoundLamps& found)
{
    return SunSearch(texels, outside, hits, radiance, sides, found).run();
}

TexelMarks markShade(const Sun& sun, const Texels& texels, const SurfelRadiance& radiance,
                     const LitSides& sides, std::span<AreaSample> onSides)
{
    const float brightness = luminance(sunRadiance(sun));
    std::vector<uint8_t> isPlainShaded(radiance.plain.size(), 0);
    for (size_t s = 0; s < isPlainShaded.size(); ++s) {
        const float plain = radiance.plainArea[s];
        if (plain <= 0.0f) continue;
        const float sent = kPi * luminance(radiance.plain[s]);
        const float without = luminance(sides.direct[s] + sides.gathered.irradiance[s]);
        const float with = without + brightness * onSides[s].open;
        const bool isPaintWithout = sent >= kBlackest * without && sent < without;
        if (sent >= kBlackest * with || !isPaintWithout) continue; // black paint is black anyway
        isPlainShaded[s] = 1;
        onSides[s].visible *= 1.0f - plain / (plain + radiance.clippedArea[s]);
    }
    TexelMarks marks;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        std::vector<uint8_t>& ofPage = marks.emplace_back(page.count(), uint8_t{0});
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                if (isPlainShaded[page.runs[run].surfel] != 0 &&
                    radiance.isClipped[p][page.pixel[i]] == 0)
                    ofPage[i] = 1;
    }
    return marks;
}

bool isSunlit(const RayScene& outside, const Sun& sun, const FoundLamp& lamp)
{
    float area = 0.0f;
    float lit = 0.0f;
    for (const ClippedPatch& patch : lamp.patches) {
        area += patch.area;
        if (glm::dot(patch.normal, sun.direction) < kGrazing) continue;
        if (!outside.occluded({patch.position + kOffScan * patch.normal, sun.direction}))
            lit += patch.area;
    }
    return lit > kMostSeesOut * area;
}

} // namespace relamp
