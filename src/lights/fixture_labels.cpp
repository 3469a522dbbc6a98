#include "lights/fixture_labels.h"

#include "scan/coarsened.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr int kCoarseSide = 512;       // pixels, that of a draft, which knows no more
constexpr float kReach = 1.5f;         // surfels between a fixture and the piece that it lies on
constexpr float kLeastCovered = 0.15f; // of that piece
constexpr float kOneSided = 0.7f;      // length of a mean normal, of what faces away from a wall
constexpr float kUpright = 0.35f;      // of a unit normal, along the vertical
constexpr float kLeastWindow = 0.25f;  // m^2
constexpr float kUnderCeiling = 0.6f;  // m
constexpr float kHigh = 1.2f;          // m above the floor; what stands on a table is lower

/// A scan has crumbs outside of its room. `order` is of surfels.
RoomHeights heightsOf(const Surfels& surfels, std::vector<uint32_t> order)
{
    constexpr double kOutside = 0.01;
    std::ranges::stable_sort(order, {}, [&](uint32_t s) { return surfels.position[s].y; });
    double all = 0.0;
    for (const uint32_t s : order) all += static_cast<double>(surfels.area[s]);
    double below = 0.0;
    RoomHeights heights;
    for (const uint32_t s : order) {
        if (below <= kOutside * all) heights.floor = surfels.position[s].y;
        if (below <= (1.0 - kOutside) * all) heights.ceiling = surfels.position[s].y;
        below += static_cast<double>(surfels.area[s]);
    }
    return heights;
}

RoomHeights heightsOfAll(const Surfels& surfels)
{
    std::vector<uint32_t> all(surfels.count());
    std::iota(all.begin(), all.end(), 0u);
    return heightsOf(surfels, std::move(all));
}

/// Heights of the rooms that fixtures are in; a house has several storeys.
class HeightsOfRooms
{
public:
    /// `whole`: of the house, or of its one room, for which a coarse copy's are good enough.
    HeightsOfRooms(const Surfels& surfels, std::span<const uint8_t> roomOfSurfel,
                   const RoomHeights& whole)
        : roomOfSurfel_(roomOfSurfel), whole_(whole)
    {
        std::vector<std::vector<uint32_t>> ofRoom;
        for (uint32_t s = 0; s < roomOfSurfel_.size(); ++s) {
            ofRoom.resize(std::max(ofRoom.size(), size_t{1} + roomOfSurfel_[s]));
            ofRoom[roomOfSurfel_[s]].push_back(s);
        }
        for (std::vector<uint32_t>& order : ofRoom)
            rooms_.push_back(heightsOf(surfels, std::move(order)));
    }

    /// Of the room of the first of its patches that lies on a surfel; else of all.
    [[nodiscard]] const RoomHeights& around(std::span<const ClippedPatch> fixture) const
    {
        for (const ClippedPatch& patch : fixture)
            if (patch.surfel < roomOfSurfel_.size()) return rooms_[roomOfSurfel_[patch.surfel]];
        return whole_;
    }

private:
    std::span<const uint8_t> roomOfSurfel_; // empty: there is one room
    std::vector<RoomHeights> rooms_;
    RoomHeights whole_;
};

const char* kindOf(const Candidate& piece, const RoomHeights& room)
{
    const float length = glm::length(piece.normal);
    const bool isUpright = std::abs(piece.normal.y) < kUpright * length;
    if (isUpright && isFlat(piece) && piece.area > kLeastWindow) return "window";
    const float above = piece.centre.y - room.floor;
    const float below = room.ceiling - piece.centre.y;
    if (below < kUnderCeiling && below < above) return "ceiling lamp";
    if (above < kHigh) return "table lamp";
    return isUpright && length > kOneSided ? "wall lamp" : "floor lamp";
}

FixtureLabel labelOf(const Candidate& piece, const RoomHeights& room, int id)
{
    return {id, fmt::format("{} {}", kindOf(piece, room), id)};
}

/// What ends sharply comes first, as lamps do; each part from the largest.
std::vector<Candidate> piecesOf(const Texels& texels, Progress& progress)
{
    const SurfelRadiance radiance = collectRadiance(texels, progress);
    std::vector<Candidate> pieces = findCandidates(texels, radiance);
    std::stable_partition(pieces.begin(), pieces.end(),
                          [&](const Candidate& piece) { return !fades(texels, radiance, piece); });
    return pieces;
}

/// The burnt-out pieces of a scan, and which fixture lies on which.
class NumberedPieces
{
public:
    NumberedPieces(std::vector<Candidate> pieces, float surfelSize)
        : reach_(kReach * surfelSize), pieces_(std::move(pieces))
    {
        for (const Candidate& piece : pieces_) around_.push_back(boundsAround(piece, reach_));
    }

    [[nodiscard]] int count() const { return static_cast<int>(pieces_.size()); }

    /// Labels the fixtures that have none, as far as they lie on a piece; each piece's is given
    /// once. Numbers begin with `first`.
    void label(std::span<const std::vector<ClippedPatch>> surfaces, const HeightsOfRooms& rooms,
               int first, std::vector<FixtureLabel>& labels) const;

private:
    struct Cover
    {
        size_t fixture;
        size_t piece;
        float area; // m^2
    };
    void addCovers(std::span<const ClippedPatch> surface, size_t fixture,
                   std::vector<Cover>& covers) const;
    [[nodiscard]] size_t nearestTo(glm::vec3 place) const;

    float reach_; // m
    std::vector<Candidate> pieces_;
    std::vector<Bounds> around_; // of pieces: what is further is not near one
};

/// The piece with the patch nearest to a place; their count where none is near.
size_t NumberedPieces::nearestTo(glm::vec3 place) const
{
    size_t nearest = pieces_.size();
    float least = reach_ * reach_;
    for (size_t p = 0; p < pieces_.size(); ++p) {
        if (!around_[p].contains(place)) continue;
        for (const ClippedPatch& patch : pieces_[p].patches) {
            const glm::vec3 way = patch.position - place;
            if (glm::dot(way, way) >= least) continue;
            least = glm::dot(way, way);
            nearest = p;
        }
    }
    return nearest;
}

void NumberedPieces::addCovers(std::span<const ClippedPatch> surface, size_t fixture,
                               std::vector<Cover>& covers) const
{
    std::vector<float> area(pieces_.size() + 1, 0.0f);
    for (const ClippedPatch& patch : surface) area[nearestTo(patch.position)] += patch.area;
    for (size_t p = 0; p < pieces_.size(); ++p)
        if (area[p] > kLeastCovered * pieces_[p].area) covers.push_back({fixture, p, area[p]});
}

void NumberedPieces::label(std::span<const std::vector<ClippedPatch>> surfaces,
                           const HeightsOfRooms& rooms, int first,
                           std::vector<FixtureLabel>& labels) const
{
    std::vector<Cover> covers;
    for (size_t f = 0; f < surfaces.size(); ++f)
        if (labels[f].id < 0) addCovers(surfaces[f], f, covers);
    std::stable_sort(covers.begin(), covers.end(),
                     [](const Cover& a, const Cover& b) { return a.area > b.area; });
    std::vector<bool> isGiven(pieces_.size(), false);
    for (const Cover& cover : covers) {
        FixtureLabel& label = labels[cover.fixture];
        if (label.id >= 0 || isGiven[cover.piece]) continue;
        isGiven[cover.piece] = true;
        label = labelOf(pieces_[cover.piece], rooms.around(surfaces[cover.fixture]),
                        first + static_cast<int>(cover.piece));
    }
}

bool areAllLabelled(std::span<const FixtureLabel> labels)
{
    return std::ranges::all_of(labels, [](const FixtureLabel& label) { return label.id >= 0; });
}

} // namespace

void putLabel(const FixtureLabel& label, Fixture& fixture)
{
    fixture.id = label.id;
    fixture.name = label.name;
}

CoarsePieces coarsePiecesOf(const Texels& texels, Progress& progress)
{
    const Scan copy =
        coarseCopyOf(*texels.scan, kCoarseSide, [&](size_t page) { texels.letGo(page); });
    const Texels coarse = rasterizeAtlas(copy, progress, {.layered = true});
    return {piecesOf(coarse, progress), heightsOfAll(coarse.surfels), coarse.surfels.size};
}

std::vector<FixtureLabel> labelsOf(const Texels& texels, const CoarsePieces& coarse,
                                   std::span<const std::vector<ClippedPatch>> surfaces,
                                   std::span<const uint8_t> roomOfSurfel, Progress& progress)
{
    std::vector<FixtureLabel> labels(surfaces.size());
    if (labels.empty()) return labels;
    const HeightsOfRooms rooms(texels.surfels, roomOfSurfel,
                               roomOfSurfel.empty() ? coarse.heights
                                                    : heightsOfAll(texels.surfels));
    const NumberedPieces large(coarse.pieces, coarse.surfelSize);
    large.label(surfaces, rooms, 0, labels);
    if (areAllLabelled(labels)) return labels;
    const NumberedPieces small(piecesOf(texels, progress), texels.surfels.size);
    small.label(surfaces, rooms, large.count(), labels);
    int next = large.count() + small.count();
    for (size_t f = 0; f < labels.size(); ++f)
        if (labels[f].id < 0)
            labels[f] = labelOf(candidateOf(surfaces[f]), rooms.around(surfaces[f]), next++);
    return labels;
}

} // namespace relamp
