#pragma once

#include "fit/fit_data.h"
#include "fit/suspects.h"
#include "relamp/gather.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/gather.h"
#include "shading/hit_lists.h"
#include "shading/lit_sides.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace relamp
{

/// What a scan tells of the lamps in it, whichever these are: places all over its surfaces with
/// what they show, pairs of them that are of one material, and the light between them.
///
/// The arguments of the constructor must outlive it. Places come in a fixed order: those that are
/// measured, then burnt-out walls.
class LampEvidence
{
public:
    LampEvidence(const Texels& texels, const RayScene& scene, const HitLists& hits,
                 const SurfelRadiance& radiance, Quality quality);

    /// Whether there are pairs to be had.
    [[nodiscard]] bool tells() const { return places_.size() > 1; }
    /// Draws the pairs; once, for what places show of their material does not change with the
    /// lamps.
    void drawAllPairs();
    /// `perPlace` is one of kPairsFirst, kPairsOfTrial, kPairs; drawAllPairs() comes before.
    [[nodiscard]] std::span<const MaterialPair> pairs(size_t perPlace) const;

    /// Fills in what each suspect does at all places, by that many rays from each origin there.
    void look(std::span<Suspect> suspects, size_t raysPerOrigin) const;
    /// Takes the burnt-out texels of these for lamps, and of all others for walls.
    void letShine(std::span<const Suspect> suspects);
    /// What there is to fit their radiances by. Burnt-out places are those that do not shine.
    [[nodiscard]] FitData dataOf(std::span<const Suspect> suspects) const;
    /// Lets burnt-out walls and backs settle in the light of these, and fills in their `onSides`.
    void settle(std::span<Suspect> suspects, glm::vec3 ambient);
    [[nodiscard]] const RadianceField& field() const { return field_; }

    static constexpr size_t kPairsFirst = 3; // a place, for the first look at all candidates
    static constexpr size_t kPairsOfTrial = 4;
    static constexpr size_t kPairs = 6;

private:
    void choosePlaces(size_t most);
    void chooseBurntOut();
    void findAround();
    [[nodiscard]] size_t measured() const { return places_.size() - burntOut_.size(); }
    void addGathered(const Gathered& gathered, uint32_t place, size_t at, FitData& data) const;

    const Texels& texels_;
    const RayScene& scene_;
    const HitLists& hits_;
    const SurfelRadiance& radiance_;
    std::vector<uint32_t> places_;        // surfels, which are also the lists of their fronts
    std::vector<ClippedPatch> burntOut_;  // of the last of these, which are
    std::vector<uint32_t> placeInAround_; // [surfel]: its number among those around places
    RadianceField field_;
    SettlingGather settling_;                           // by these
    std::map<size_t, std::vector<MaterialPair>> pairs_; // by how many a place
};

} // namespace relamp
