#include "fit/lamps.h"

#include "base/call_all.h"
#include "base/radiometry.shared.h"
#include "fit/bright_walls.h"
#include "fit/gained.h"
#include "fit/lamp_evidence.h"
#include "fit/lamp_groups.h"
#include "fit/lit_powers.h"
#include "fit/missed.h"
#include "fit/powers.h"
#include "fit/suspects.h"
#include "lights/lamp_body.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr size_t kMostCandidates = 96;
constexpr size_t kSearchSteps = 4;       // of the search, as progress tells
constexpr double kToleranceFirst = 1e-4; // of a fit that only tells what is worth looking at
constexpr size_t kRaysPerOrigin = 6; // at a place, to those that remain: noise would make them weak
constexpr float kHardlyWhite = 1.05f;   // luminance at the first look, which few rays make dim
constexpr float kAboutWhite = 1.2f;     // below, it lights its surroundings as a wall would
constexpr float kHardlyShare = 0.001f;  // of the light at places
constexpr float kLeastShare = 0.0015f;  // below, a lamp does not matter
constexpr float kLeastReach = 0.02f;    // of places that see it; else it is in a pocket of the scan
constexpr float kExplainedWhite = 0.8f; // of white
constexpr float kHardlyBrighter = 0.7f; // log radiance over that of a wall in its place
constexpr float kErrorsBrighter = 0.13f;  // standard errors more
constexpr float kPieceMissed = 0.008f;    // rise of the fit's loss; it lights 1 % of the pairs
constexpr float kWallPieceMissed = 0.03f; // of what would be burnt out anyway
constexpr float kWallMissed = 0.04f;      // of that, once pieces are joined to lamps
constexpr float kSmallWallMissed = 2.5f;  // times that, of pieces of less than kLarge
constexpr float kFadingMissed = 1.5f;     // times that, of what fades as walls do
constexpr float kGreyWall = 0.5f;         // radiance
constexpr float kDarkWall = 0.2f;         // what the room hardly lights hardly lights the room
constexpr float kGreyMissed = 0.003f;     // of what is small
constexpr float kLarge = 100.0f;          // surfels
constexpr float kSmallLamp = 10.0f;       // surfels
constexpr float kSpeck = 1.0f;            // surfels
constexpr float kHardlyMissed = 0.15f;    // of these
constexpr float kBright = 500.0f;         // few lamps are brighter
constexpr float kBrightMissed = 0.01f;    // of those, a factor of e beyond
constexpr float kGained = 0.004f;         // fall of the fit's loss; a wall's piece gains less
constexpr size_t kMostRegained = 8;       // at a time
constexpr int kMostRegains = 4;
constexpr float kTold = 0.5f; // of the prior's variance; beyond, data decide

class LampSearch
{
public:
    LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
               const SurfelRadiance& radiance, const GatherOptions& options, Progress& progress);

    FoundLamps run();

private:
    void takeCandidates(const GatherOptions& options);
    void addSuspects(LampGroup group);
    void fit(size_t pairsPerPlace, bool oneChannel);
    size_t passOver(std::span<const uint8_t> gone);
    size_t dropWalls(float leastRadiance, float leastShare, float leastReach);
    size_t dropExplained();
    void dropUnlikely();
    void dropNeedless(float missedIfWall);
    [[nodiscard]] std::vector<Suspect> worthAnotherLook() const;
    void regain();
    [[nodiscard]] std::vector<float> rises();
    [[nodiscard]] std::vector<float> needs(float missedIfWall);
    [[nodiscard]] BrightWalls walls() const;
    [[nodiscard]] float brightnessOfWall(const BrightWalls& walls, size_t suspect) const;
    [[nodiscard]] bool isExplained(const BrightWalls& walls, size_t suspect) const;

    const Texels& texels_;
    const RayScene& scene_;
    const HitLists& hits_;
    const SurfelRadiance& radiance_;
    Progress::Stage stage_;
    LampEvidence evidence_;
    std::vector<Suspect> suspects_;
    std::vector<Suspect> passedOver_; // as they were looked at last
    std::set<size_t> triedAgain_;     // bodies
    std::vector<std::string> warnings_;
    Powers powers_;
    bool isFitted_ = false;
};

LampSearch::LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
                       const SurfelRadiance& radiance, const GatherOptions& options,
                       Progress& progress)
    : texels_(texels), scene_(scene), hits_(hits), radiance_(radiance),
      stage_(progress, "lamps", kSearchSteps),
      evidence_(texels, scene, hits, radiance, options.quality)
{
    callAll([&] { takeCandidates(options); }, [&] { evidence_.drawAllPairs(); });
}

void LampSearch::takeCandidates(const GatherOptions& options)
{
    std::vector<Candidate> candidates = findCandidates(texels_, radiance_);
    std::vector<uint8_t> isGiven(candidates.size() + 1, 0);
    std::vector<uint8_t> isRefused(candidates.size() + 1, 0);
    const auto mark = [&](glm::vec3 place, std::vector<uint8_t>& marks) {
        const size_t nearest = nearestTo(candidates, place);
        marks[nearest] = 1;
        if (nearest == candidates.size())
            warnings_.push_back(fmt::format("nothing is burnt out near {}, {}, {}: what was said "
                                            "of a light there was passed over",
                                            place.x, place.y, place.z));
    };
    for (const glm::vec3 place : options.lights) mark(place, isGiven);
    for (const glm::vec3 place : options.notLights) mark(place, isRefused);
    isGiven.resize(candidates.size());
    size_t c = 0;
    std::erase_if(isGiven, [&](uint8_t) { return isRefused[c++] != 0; });
    c = 0;
    std::erase_if(candidates, [&](const Candidate&) { return isRefused[c++] != 0; });
    LampGroups lamps = groupLamps(std::move(candidates), isGiven, kMostCandidates);
    if (lamps.leftOut > 0)
        warnings_.push_back(fmt::format("{} burnt-out pieces, {:.2f} m^2 together, are more than "
                                        "the {} largest and were taken for no lights; point at "
                                        "those that are with --light",
                                        lamps.leftOut, lamps.areaLeftOut, kMostCandidates));
    for (LampGroup& group : lamps.groups) addSuspects(std::move(group));
    evidence_.look(suspects_, 1);
    stage_.advance();
}

/// A group is flat and so has no far side.
void LampSearch::addSuspects(LampGroup group)
{
    const size_t body = suspects_.size();
    Suspect suspect{.candidate = std::move(group.whole),
                    .isGiven = group.isGiven,
                    .body = body,
                    .ends = std::move(group.ends)};
    Candidate unseen;
    if (suspect.ends.empty()) unseen = unseenSideOf(suspect.candidate, texels_, scene_);
    suspects_.push_back(std::move(suspect));
    if (unseen.patches.empty()) return;
    suspects_.push_back({.candidate = std::move(unseen), .body = body, .isUnseen = true});
}

void LampSearch::fit(size_t pairsPerPlace, bool oneChannel)
{
    evidence_.letShine(suspects_);
    const FitData data = evidence_.dataOf(suspects_);
    const std::span pairs = evidence_.pairs(pairsPerPlace);
    PowersOptions options{.oneChannel = oneChannel, .alike = alikesOf(suspects_)};
    if (isFitted_) { // most of it is known; a narrower loss finds the rest
        options.firstScale = 2.0 * options.lastScale;
        for (const Suspect& suspect : suspects_) options.start.push_back(suspect.radiance);
        options.start.push_back(powers_.ambient);
    } else {
        options.tolerance = kToleranceFirst;
    }
    isFitted_ = true;
    std::vector<float> areas;
    for (const Suspect& suspect : suspects_) areas.push_back(suspect.candidate.area);
    powers_ = oneChannel ? fitPowers(data, pairs, options)
                         : fitLitPowers(data, pairs, areas, std::move(options));
    for (size_t f = 0; f < suspects_.size(); ++f) {
        suspects_[f].radiance = powers_.radiance[f];
        suspects_[f].logError = powers_.logError[f];
        suspects_[f].told = powers_.told[f];
    }
    findShares(data, powers_.ambient, suspects_);
    stage_.advance(0);
}

/// One flag a suspect; returns how many went.
size_t LampSearch::passOver(std::span<const uint8_t> gone)
{
    size_t kept = 0;
    for (size_t f = 0; f < suspects_.size(); ++f) {
        if (gone[f] != 0) passedOver_.push_back(suspects_[f]);
        if (gone[f] == 0) std::swap(suspects_[kept++], suspects_[f]);
    }
    const size_t dropped = suspects_.size() - kept;
    suspects_.resize(kept);
    return dropped;
}

size_t LampSearch::dropWalls(float leastRadiance, float leastShare, float leastReach)
{
    std::vector<uint8_t> gone;
    for (const Suspect& suspect : suspects_)
        gone.push_back(!suspect.isGiven &&
                       (luminance(suspect.radiance) < leastRadiance || suspect.share < leastShare ||
                        suspect.reach() < leastReach));
    return passOver(gone) + dropHalves(suspects_);
}

BrightWalls LampSearch::walls() const
{
    std::vector<std::span<const ClippedPatch>> lamps;
    for (const Suspect& suspect : suspects_) lamps.emplace_back(suspect.candidate.patches);
    return {texels_, scene_, hits_, lamps};
}

float LampSearch::brightnessOfWall(const BrightWalls& walls, size_t f) const
{
    std::vector<glm::vec3> radiances;
    for (const Suspect& suspect : suspects_) radiances.push_back(suspect.radiance);
    return walls.insteadOf(f, evidence_.field(), powers_.ambient, radiances);
}

/// Whether a wall in its place would be burnt out, and it is hardly brighter than that wall.
bool LampSearch::isExplained(const BrightWalls& walls, size_t f) const
{
    const float wall = brightnessOfWall(walls, f);
    const float above = std::log(luminance(suspects_[f].radiance) / std::max(wall, 1.0f));
    return wall > kExplainedWhite &&
           above < kHardlyBrighter + kErrorsBrighter * suspects_[f].logError.g;
}

/// The weakest that is explained goes first: what it was thought to do falls to the others.
size_t LampSearch::dropExplained()
{
    std::vector<size_t> order(suspects_.size());
    for (size_t f = 0; f < order.size(); ++f) order[f] = f;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return suspects_[a].power() < suspects_[b].power();
    });
    std::vector<uint8_t> gone(suspects_.size(), 0);
    const BrightWalls ofAll = walls();
    for (const size_t f : order) {
        if (suspects_[f].isGiven || suspects_[f].isUnseen || !isExplained(ofAll, f)) continue;
        gone[f] = 1;
        suspects_[f].radiance = glm::vec3(0.0f); // it explains nobody any more
    }
    return passOver(gone);
}

/// How much worse the pairs agree without one lamp, the others free to take its part.
std::vector<float> LampSearch::rises()
{
    const FitData data = evidence_.dataOf(suspects_);
    PowersOptions options{.firstScale = PowersOptions{}.lastScale, .oneChannel = true};
    options.alike = alikesOf(suspects_);
    options.start = powers_.radiance;
    options.start.push_back(powers_.ambient);
    std::vector<std::vector<uint8_t>> gone(suspects_.size());
    for (size_t f = 0; f < gone.size(); ++f) gone[f] = goneWith(suspects_, f);
    return missed(data, evidence_.pairs(LampEvidence::kPairsOfTrial), options, gone);
}

/// How much a lamp of `surfels` must be missed to stay that ends sharply. Where a wall would be
/// burnt out, much, and what is small there, which are many, most; where it would be grey, hardly
/// or not at all: something has to make it bright. Where it would be dark, the room does not light
/// it, and it does not light the room: what is bright there, and what is small, is mostly a flaw of
/// the texture.
float missedAtLeast(float brightnessOfWall, float surfels, float ifWall)
{
    if (brightnessOfWall > kExplainedWhite)
        return surfels < kLarge ? kSmallWallMissed * ifWall : ifWall;
    if (surfels < kSpeck) return kWallMissed;
    if (brightnessOfWall < kDarkWall)
        return std::lerp(kWallPieceMissed, kGreyMissed, brightnessOfWall / kDarkWall);
    const float aboveGrey = (brightnessOfWall - kGreyWall) / (kExplainedWhite - kGreyWall);
    return std::max(surfels < kSmallLamp ? kGreyMissed : 0.0f, kPieceMissed * aboveGrey);
}

/// How much more a lamp of that radiance must be missed: a speck can be anything to the fit.
float missedIfBright(float radiance)
{
    return kBrightMissed * std::max(std::log(radiance / kBright), 0.0f);
}

/// By how much more than needed for it to stay each suspect is missed, as a ratio. One model is
/// missed as a whole, and a pane where a wall would be grey as much as the one beside it.
std::vector<float> LampSearch::needs(float missedIfWall)
{
    const float areaOfSurfel = texels_.surfels.size * texels_.surfels.size;
    const std::vector<float> rise = rises();
    const BrightWalls ofAll = walls();
    std::vector<float> need(rise.size(), std::numeric_limits<float>::max());
    std::vector<uint8_t> mayBePane(rise.size(), 0);
    for (uint32_t f = 0; f < need.size(); ++f) {
        const Suspect& suspect = suspects_[f];
        const bool likeWall = !suspect.isUnseen && fades(texels_, radiance_, suspect.candidate);
        const float wall = likeWall || suspect.isUnseen ? 1.0f : brightnessOfWall(ofAll, f);
        float surfels = 0.0f;
        float risen = 0.0f;
        for (const uint32_t member : familyOf(suspects_, f)) {
            surfels += suspects_[member].candidate.area / areaOfSurfel;
            risen += rise[member];
        }
        const float ifWall = likeWall ? kFadingMissed * missedIfWall : missedIfWall;
        const float least =
            missedAtLeast(wall, surfels, ifWall) + missedIfBright(luminance(suspect.radiance));
        if (!suspect.isGiven && least > 0.0f) need[f] = risen / least;
        mayBePane[f] = wall < kExplainedWhite && surfels >= kSmallLamp;
    }
    for (size_t f = 0; f < need.size(); ++f)
        for (size_t other = 0; other < need.size() && mayBePane[f] != 0; ++other)
            if (need[other] > 1.0f && need[f] <= 1.0f &&
                arePanesOfOne(suspects_[f], suspects_[other]))
                need[f] = need[other];
    return need;
}

/// The least missed go first, and those that are hardly missed all at once.
void LampSearch::dropNeedless(float missedIfWall)
{
    while (suspects_.size() > 1) {
        const std::vector<float> need = needs(missedIfWall);
        const float least = *std::min_element(need.begin(), need.end());
        if (least > 1.0f) break;
        const float limit = std::max(least, kHardlyMissed);
        std::vector<uint8_t> gone;
        for (const float n : need) gone.push_back(n <= limit);
        passOver(gone);
        dropHalves(suspects_);
        fit(LampEvidence::kPairs, true);
    }
}

/// Candidates that were passed over and would do much for the fit as it is: the light of a window
/// can fall to the crumbs along its frame before these are known for what they are. Not what is
/// small: it can be anything to the fit.
std::vector<Suspect> LampSearch::worthAnotherLook() const
{
    const float small = kSmallLamp * texels_.surfels.size * texels_.surfels.size;
    std::vector<const Suspect*> passed;
    std::vector<std::span<const float>> direct;
    for (const Suspect& suspect : passedOver_) {
        if (suspect.isUnseen || suspect.candidate.area < small) continue;
        if (triedAgain_.contains(suspect.body)) continue;
        passed.push_back(&suspect);
        direct.emplace_back(suspect.direct);
    }
    const std::vector<Gain> gains = gained(
        evidence_.dataOf(suspects_), evidence_.pairs(LampEvidence::kPairsFirst), powers_, direct);
    std::multimap<float, size_t, std::greater<>> byGain;
    for (size_t i = 0; i < gains.size(); ++i)
        if (gains[i].loss > kGained) byGain.emplace(gains[i].loss, i);
    std::vector<Suspect> found;
    for (const auto& [gain, i] : byGain) {
        if (found.size() == kMostRegained) break;
        found.push_back(*passed[i]);
        found.back().radiance = glm::vec3(gains[i].radiance);
    }
    return found;
}

/// Looks again at what was passed over, until that makes the pairs agree no better.
void LampSearch::regain()
{
    for (int round = 0; round < kMostRegains; ++round) {
        std::vector<Suspect> again = worthAnotherLook();
        if (again.empty()) return;
        const std::vector<Suspect> before = suspects_;
        const Powers powersBefore = powers_;
        for (const Suspect& suspect : again) triedAgain_.insert(suspect.body);
        evidence_.look(again, kRaysPerOrigin);
        suspects_.insert(suspects_.end(), again.begin(), again.end());
        dropUnlikely();
        dropNeedless(kWallPieceMissed);
        if (powers_.loss < powersBefore.loss - kGained) continue;
        suspects_ = before;
        powers_ = powersBefore;
        return;
    }
}

std::string unknownAt(glm::vec3 place, size_t lamps)
{
    if (lamps > 1)
        return fmt::format("the scan does not tell how bright the {} lights around {:.2f}, {:.2f}, "
                           "{:.2f} are, for they light little that can be seen; their radiance is "
                           "a guess. Set it in lights.json and pass that with --lights",
                           lamps, place.x, place.y, place.z);
    return fmt::format("the scan does not tell how bright the light at {:.2f}, {:.2f}, {:.2f} is, "
                       "for it lights little that can be seen; its radiance is a guess. Set it in "
                       "lights.json and pass that with --lights",
                       place.x, place.y, place.z);
}

/// Fits until no suspect is a wall, or could be one.
void LampSearch::dropUnlikely()
{
    do fit(LampEvidence::kPairs, true);
    while (dropWalls(kAboutWhite, kLeastShare, kLeastReach) + dropExplained() > 0);
}

FoundLamps LampSearch::run()
{
    FoundLamps found;
    found.warnings = std::move(warnings_);
    if (!evidence_.tells()) return found;
    fit(LampEvidence::kPairsFirst, true);
    dropWalls(kHardlyWhite, kHardlyShare, 0.0f);
    evidence_.look(suspects_, kRaysPerOrigin);
    stage_.advance();
    dropUnlikely();
    dropNeedless(kWallPieceMissed);
    regain();
    joinPieces(suspects_);
    fit(LampEvidence::kPairs, true);
    dropNeedless(kWallMissed);
    fit(LampEvidence::kPairs, false);
    stage_.advance();
    evidence_.settle(suspects_, powers_.ambient);
    fit(LampEvidence::kPairs, false);
    dropWalls(kAboutWhite, kLeastShare, kLeastReach);
    std::stable_sort(suspects_.begin(), suspects_.end(),
                     [](const Suspect& a, const Suspect& b) { return a.power() > b.power(); });
    for (Suspect& suspect : suspects_) {
        const bool isDetermined = suspect.told >= kTold;
        if (!isDetermined)
            found.warnings.push_back(unknownAt(suspect.candidate.centre, suspect.ends.size()));
        found.lamps.push_back({std::move(suspect.candidate.patches), suspect.radiance,
                               suspect.logError, std::move(suspect.onSides), false, isDetermined,
                               std::move(suspect.ends)});
    }
    found.ambient = powers_.ambient;
    found.residual = powers_.residual;
    stage_.advance();
    return found;
}

} // namespace

FoundLamps findLamps(const Texels& texels, const RayScene& scene, const HitLists& hits,
                     const SurfelRadiance& radiance, const GatherOptions& options,
                     Progress& progress)
{
    return LampSearch(texels, scene, hits, radiance, options, progress).run();
}

std::vector<std::span<const ClippedPatch>> singlesOf(const FoundLamp& lamp)
{
    if (lamp.ends.empty()) return {lamp.patches};
    std::vector<std::span<const ClippedPatch>> singles;
    uint32_t begin = 0;
    for (const uint32_t end : lamp.ends) {
        singles.push_back(std::span(lamp.patches).subspan(begin, end - begin));
        begin = end;
    }
    return singles;
}

std::vector<uint8_t> shinesOf(const FoundLamps& found, size_t surfels)
{
    std::vector<uint8_t> shines(surfels, 0);
    for (const FoundLamp& lamp : found.lamps)
        for (const ClippedPatch& patch : lamp.patches)
            if (patch.surfel != Surfels::kNone) shines[patch.surfel] = 1;
    return shines;
}

} // namespace relamp
