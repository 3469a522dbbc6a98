#pragma once

#include "lights/candidates.h"
#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// A surfel has two sides; the back is what rays see that pass behind a single-sided surface.
struct Side
{
    uint32_t index; // 2 * surfel, + 1 for the back

    static Side front(uint32_t surfel) { return {2 * surfel}; }
    static Side back(uint32_t surfel) { return {2 * surfel + 1}; }
    [[nodiscard]] uint32_t surfel() const { return index / 2; }
    [[nodiscard]] bool isBack() const { return index % 2 != 0; }
};

/// What a ray met, in four bytes: the side of a surfel, there a texel that is burnt out or not; or
/// nothing, and then which part of what lies outside it left for.
class HitTarget
{
public:
    static constexpr uint32_t kMostOfOpenings = 32; // parts of what lies outside, and small holes
    static constexpr uint32_t kMostRooms = 224;     // whose small holes are a part by themselves
    static constexpr uint32_t kMostParts = kMostOfOpenings + kMostRooms;

    static HitTarget nothing(uint32_t part = 0) { return HitTarget(~part); }
    static HitTarget of(Side side, bool clipped)
    {
        return HitTarget(side.index << 1 | (clipped ? 1u : 0u));
    }

    [[nodiscard]] bool isNothing() const { return bits_ > ~kMostParts; }
    [[nodiscard]] uint32_t part() const { return ~bits_; } // of nothing
    [[nodiscard]] Side side() const { return {bits_ >> 1}; }
    [[nodiscard]] bool isClipped() const { return (bits_ & 1u) != 0; }

private:
    explicit HitTarget(uint32_t bits) : bits_(bits) {}
    uint32_t bits_;
};

/// A large hole of a scan: a window, a door, a ceiling that is not there.
struct Hole
{
    uint32_t part = 0;      // the first of those that lie behind it
    uint32_t parts = 1;     // of a hole in an upright side two: above and below the horizon
    glm::vec3 centre{0.0f}; // world, m: the middle of where rays leave the box around the scan
    glm::vec3 normal{0.0f}; // unit, into the room
    float area = 0.0f;      // m^2
};

/// Some of the rooms of a house.
using RoomSet = std::bitset<HitTarget::kMostRooms>;

/// Cosine-distributed rays of the sides of surfels and what they met. Cast once per scan: light
/// that changes needs no new rays.
struct HitLists
{
    static constexpr int32_t kNoList = -1;

    std::vector<Side> sideOfList;         // fronts first: that of surfel s has list s
    std::vector<int32_t> listOfSide;      // kNoList for a side that nobody sees
    std::vector<uint32_t> firstTarget{0}; // of lists, and one more
    std::vector<HitTarget> targets;
    std::vector<float> shareOfPart{0.0f}; // of parts outside: of all light that could reach fronts
    size_t rooms = 1;                   // with small holes of their own: part 0 and the last of all
    std::vector<uint8_t> roomOfSurfel;  // as roomsOfSurfels(); empty: there is one
    std::vector<RoomSet> roomsSeen;     // of rooms: those that it sees more than a glimpse of
    std::vector<Hole> holes;            // by falling area
    std::vector<uint32_t> partOfSquare; // of OpeningSquares; 0: a small hole
    // Where lamps can be that the scan has no surface for: squares of no surfel just beyond the
    // holes in its top and bottom, which face the room, those first that most rays leave through.
    // What few rays leave through is left out, so a scan that is whole has none.
    std::vector<Candidate> squares;

    /// The room of a surfel; all where there is one room.
    [[nodiscard]] RoomSet roomOf(uint32_t surfel) const
    {
        return roomOfSurfel.empty() ? RoomSet().set() : RoomSet().set(roomOfSurfel[surfel]);
    }
    /// The rooms that its own sees anything of.
    [[nodiscard]] RoomSet roomsSeenBy(uint32_t surfel) const
    {
        return roomOfSurfel.empty() ? RoomSet().set() : roomsSeen[roomOfSurfel[surfel]];
    }

    [[nodiscard]] std::span<const HitTarget> targetsOf(size_t list) const
    {
        return {targets.data() + firstTarget[list], targets.data() + firstTarget[list + 1]};
    }
};

/// The rays of a side's list, as many as one wants: cosine-distributed, all over its texels.
class RaysOfSide
{
public:
    RaysOfSide(const SurfelSites& sites, Side side);

    [[nodiscard]] Ray operator[](size_t i) const;

private:
    static constexpr size_t kMost = 32;

    const SurfelSites& sites_;
    Side side_;
    glm::vec2 shift_;
    size_t count_;          // of texels
    TexelSite site_[kMost]; // of them, where they are that few: rays come back to them
};

/// Casts rays from the fronts of all surfels, then from the backs that were met, then from those
/// that these met. Rays start all over a surfel's texels, so that a list averages over its area.
///
/// Fronts' lists have `rays` rays in the mean: more where these do not agree and much of the light
/// hangs on them, as in a dark corner that one of them in ten leaves, and no fewer than half. A
/// back's has a fifth of that.
HitLists castHitLists(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance,
                      size_t rays, Progress& progress);

} // namespace relamp
