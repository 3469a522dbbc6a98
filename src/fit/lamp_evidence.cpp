#include "fit/lamp_evidence.h"

#include "base/parallel.h"
#include "fit/pairs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kEvidencePlaces = 6000;
constexpr size_t kPlacesOfDraft = 2000;
constexpr size_t kPlacesBurntOut = 150;
constexpr float kAllBurntOut = 0.9f; // of a surfel's area
constexpr float kAround = 1.6f;      // surfel sizes

std::vector<SoughtLamp> soughtOf(std::span<const Suspect> suspects, size_t raysPerOrigin)
{
    std::vector<SoughtLamp> lamps;
    for (const Suspect& suspect : suspects)
        lamps.push_back({AreaLight(suspect.candidate.patches), raysPerOrigin * suspect.rays()});
    return lamps;
}

/// Calls `visit(surfel)` for those around a place that bounce light is averaged over.
template<class Visit>
void forEachAround(const Surfels& surfels, uint32_t place, const Visit& visit)
{
    for (const uint32_t n : surfels.neighborsOf(place)) {
        const glm::vec3 way = surfels.position[n] - surfels.position[place];
        if (glm::dot(way, way) <= kAround * kAround * surfels.size * surfels.size) visit(n);
    }
}

} // namespace

LampEvidence::LampEvidence(const Texels& texels, const RayScene& scene, const HitLists& hits,
                           const SurfelRadiance& radiance, Quality quality)
    : texels_(texels), scene_(scene), hits_(hits), radiance_(radiance), field_(fieldOf(radiance))
{
    choosePlaces(quality == Quality::draft ? kPlacesOfDraft : kEvidencePlaces);
    if (tells()) chooseBurntOut();
    findAround();
}

/// Evenly along the curve through space that surfels are sorted by.
void LampEvidence::choosePlaces(size_t most)
{
    std::vector<uint32_t> good;
    for (uint32_t s = 0; s < texels_.surfels.count(); ++s)
        if (radiance_.plainArea[s] > 0.0f &&
            radiance_.clippedArea[s] < 0.02f * radiance_.plainArea[s])
            good.push_back(s);
    const size_t count = std::min(most, good.size());
    for (size_t i = 0; i < count; ++i) places_.push_back(good[i * good.size() / count]);
}

/// Burnt-out walls that bound the lamps from below; lamps are left out as long as they are some.
void LampEvidence::chooseBurntOut()
{
    std::vector<ClippedPatch> whole;
    for (const ClippedPatch& patch : radiance_.clipped)
        if (patch.area > kAllBurntOut * texels_.surfels.area[patch.surfel]) whole.push_back(patch);
    const size_t count = std::min(kPlacesBurntOut, whole.size());
    for (size_t i = 0; i < count; ++i) {
        burntOut_.push_back(whole[i * whole.size() / count]);
        places_.push_back(burntOut_.back().surfel);
    }
}

void LampEvidence::findAround()
{
    std::vector<uint32_t> around; // surfels, ascending
    placeInAround_.assign(texels_.surfels.count(), 0);
    for (const uint32_t place : places_)
        forEachAround(texels_.surfels, place, [&](uint32_t n) { placeInAround_[n] = 1; });
    for (uint32_t s = 0; s < placeInAround_.size(); ++s) {
        if (placeInAround_[s] == 0) continue;
        placeInAround_[s] = static_cast<uint32_t>(around.size());
        around.push_back(s);
    }
    settling_ = SettlingGather(hits_, field_, around); // a front's list is its surfel's
}

void LampEvidence::drawAllPairs()
{
    FitData seen;
    for (size_t i = 0; i < measured(); ++i) seen.radiance.push_back(radiance_.plain[places_[i]]);
    for (const size_t perPlace : {kPairsFirst, kPairsOfTrial, kPairs})
        pairs_[perPlace] = drawPairs(seen, places_, texels_.surfels, perPlace);
}

std::span<const MaterialPair> LampEvidence::pairs(size_t perPlace) const
{
    return pairs_.at(perPlace);
}

void LampEvidence::look(std::span<Suspect> suspects, size_t raysPerOrigin) const
{
    const auto samples =
        directOfLists(texels_, scene_, hits_, soughtOf(suspects, raysPerOrigin), places_);
    for (size_t f = 0; f < suspects.size(); ++f) {
        suspects[f].direct.clear();
        for (const AreaSample& sample : samples[f]) suspects[f].direct.push_back(sample.visible);
    }
}

void LampEvidence::letShine(std::span<const Suspect> suspects)
{
    std::fill(field_.shines.begin(), field_.shines.end(), uint8_t{0});
    for (const Suspect& suspect : suspects)
        for (const ClippedPatch& patch : suspect.candidate.patches)
            if (patch.surfel != Surfels::kNone) field_.shines[patch.surfel] = 1;
}

/// Mean over the surfels around a place: bounce light changes slowly, its few rays are noisy.
void LampEvidence::addGathered(const Gathered& gathered, uint32_t place, size_t at,
                               FitData& data) const
{
    float count = 0.0f;
    forEachAround(texels_.surfels, place, [&](uint32_t n) {
        data.gathered[at] += gathered.irradiance[placeInAround_[n]];
        data.missed[at] += gathered.missed[placeInAround_[n]];
        count += 1.0f;
    });
    data.gathered[at] /= count;
    data.missed[at] /= count;
}

FitData LampEvidence::dataOf(std::span<const Suspect> suspects) const
{
    FitData data{.lamps = suspects.size()};
    std::vector<size_t> taken(measured());
    std::iota(taken.begin(), taken.end(), size_t{0});
    for (const size_t i : taken) data.radiance.push_back(radiance_.plain[places_[i]]);
    for (size_t i = 0; i < burntOut_.size(); ++i) {
        if (field_.shines[burntOut_[i].surfel] != 0) continue;
        taken.push_back(measured() + i);
        data.radiance.push_back(burntOut_[i].radiance);
        ++data.burntOut;
    }
    data.gathered.resize(taken.size(), glm::vec3(0.0f));
    data.missed.resize(taken.size(), 0.0f);
    data.direct.resize(taken.size() * data.lamps);
    const Gathered gathered = settling_.gather(field_);
    forEach(taken.size(), [&](size_t at) {
        addGathered(gathered, places_[taken[at]], at, data);
        for (size_t f = 0; f < data.lamps; ++f)
            data.direct[at * data.lamps + f] = suspects[f].direct[taken[at]];
    });
    return data;
}

void LampEvidence::settle(std::span<Suspect> suspects, glm::vec3 ambient)
{
    std::vector<glm::vec3> direct(hits_.sideOfList.size(), glm::vec3(0.0f));
    auto onSides = directOfLists(texels_, scene_, hits_, soughtOf(suspects, 1));
    for (size_t f = 0; f < suspects.size(); ++f) {
        suspects[f].onSides = std::move(onSides[f]);
        addDirect(suspects[f].onSides, suspects[f].radiance, direct);
    }
    field_ = lightSides(texels_, hits_, radiance_, std::move(direct), field_.shines, ambient).field;
}

} // namespace relamp
