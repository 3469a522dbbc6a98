#pragma once

#include "fit/camera_columns.h"
#include "fit/light_model.h"
#include "fit/pieces.h"
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

/// Surfels to look at: with next to nothing burnt out, evenly along the curve through space that
/// surfels are sorted by. As many more as there are `rooms`, >= 1, as roomsOf().
std::vector<uint32_t> placesToLookAt(const Surfels& surfels, const SurfelRadiance& radiance,
                                     Quality quality, double rooms);

/// What pieces see of each other, from some of each one's surfels.
struct PieceSights
{
    std::vector<uint32_t> lists;                  // that they look by: fronts
    std::vector<size_t> first{0};                 // of each piece in `lists`, and one more
    std::vector<std::vector<DirectLight>> direct; // on each by others, mean over its lists
};

/// What a scan tells of the lamps in it, whichever these are: places all over its surfaces with
/// what they show, pairs of them that are of one material, and the light between them.
///
/// All arguments of the constructor but `radiance` must outlive it.
class LampEvidence
{
public:
    /// `told`: surfels that a person called one paint; they are places, too, behind those that
    /// pairs are drawn of.
    LampEvidence(const Texels& texels, const RayScene& scene, const HitLists& hits,
                 SurfelRadiance radiance, Quality quality, double rooms = 1.0,
                 std::span<const MaterialPair> told = {});

    /// Whether there are pairs to be had.
    [[nodiscard]] bool tells() const { return drawn_ > 1; }
    /// Draws the pairs; once, for what places show of their material does not change with the
    /// lamps.
    void drawAllPairs();
    /// `perPlace` is kPairsFirst or kPairs; drawAllPairs() comes before.
    [[nodiscard]] std::span<const MaterialPair> pairs(size_t perPlace) const;

    /// Undoes what the camera made of light, from the texture on. Models and pairs of before keep
    /// what they have. Returns how much brighter places are than before, mean of logarithms.
    double linearize(const CameraModel& camera);
    /// Logarithms of the brightness that the texture has around each place, once this response is
    /// undone; their mean over the scan is 0.
    [[nodiscard]] Gain brightnessAround(const Response& response) const;
    [[nodiscard]] const SurfelRadiance& radiance() const { return radiance_; } // so far
    /// The pairs of places that a person called one paint.
    [[nodiscard]] std::span<const MaterialPair> told() const { return told_; }
    /// What places show in the file.
    [[nodiscard]] TexturePlaces texturePlaces() const { return {texture_, positions_}; }

    /// Further pairs, across walls that this albedo of places shows as of one paint.
    void pairWalls(std::span<const glm::vec3> albedo);
    /// Further pairs, of places that the caller adds to the model.
    void addPairs(size_t perPlace, std::span<const MaterialPair> pairs)
    {
        pairs_.at(perPlace).insert(pairs_.at(perPlace).end(), pairs.begin(), pairs.end());
    }
    [[nodiscard]] std::span<const uint32_t> places() const { return places_; } // surfels
    /// From 0 on; empty: there is one room.
    [[nodiscard]] std::span<const uint8_t> roomOfPlace() const { return roomOfPlace_; }

    /// Fills in what each piece does at all places, by no fewer rays from each origin there, and no
    /// more than kMostRays: few rays are noise, which makes the light of a lamp seem weaker.
    void look(std::span<Piece> pieces, size_t fewestRays) const;
    /// By rays, so once for a set of pieces.
    [[nodiscard]] PieceSights sightsOf(std::span<const Piece> pieces) const;
    /// The light of all of these, emit they or reflect, at places and on the pieces. `direct`: that
    /// of their model of before, if what they do at places has not changed since.
    [[nodiscard]] LightModel modelOf(std::span<const Piece> pieces, const PieceSights& sights,
                                     std::vector<std::vector<DirectLight>> direct = {});
    /// Lets burnt-out walls and backs settle in the light of these lamps, and fills in their
    /// `onSides`. Returns their light.
    LitSides settle(std::span<Piece> lamps, const OutsideLight& outside);

    // Numerics.
    static constexpr size_t kMostRays = 6;   // to a piece, from an origin at a place
    static constexpr size_t kPairsFirst = 1; // a place, for what only tells which pieces emit
    static constexpr size_t kPairs = 6;      // likewise, for how bright they are

private:
    uint32_t addPlace(uint32_t surfel);
    [[nodiscard]] double meanLogOfPlaces() const;
    void numberRooms();
    void findAround();
    void addLightOnPieces(std::span<const Piece> pieces, const PieceSights& sights,
                          LightModel& model) const;

    const Texels& texels_;
    const RayScene& scene_;
    const HitLists& hits_;
    SurfelRadiance radiance_;                 // linear
    std::vector<uint32_t> places_;            // surfels, which are also the lists of their fronts
    size_t drawn_ = 0;                        // places that pairs are drawn of, the first
    std::vector<MaterialPair> told_;          // of places
    std::vector<glm::vec3> texture_;          // of places
    std::vector<glm::vec3> positions_;        // of places, m
    double rooms_ = 1.0;                      // see LightModel
    std::vector<uint8_t> roomOfPlace_;        // see roomOfPlace()
    std::vector<glm::vec3> textureOfAll_;     // of surfels
    std::vector<glm::vec3> textureOfClipped_; // as SurfelRadiance::clipped
    std::vector<uint32_t> around_; // surfels that light of places is averaged over, ascending
    std::vector<uint32_t> placeInAround_; // [surfel]: its number among those around places
    RadianceField field_;
    SettlingGather settling_;                           // by these
    std::vector<std::vector<MissedLight>> missed_;      // of places, the mean around them
    std::map<size_t, std::vector<MaterialPair>> pairs_; // by how many a place
};

} // namespace relamp
