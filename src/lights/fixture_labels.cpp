#include "lights/fixture_labels.h"

#include "lights/candidates.h"
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

struct Heights
{
    float floor = 0.0f; // world y, m
    float ceiling = 0.0f;
};

/// Between which 98 % of the surface lie: a scan has crumbs outside of its room.
Heights heightsOf(const Surfels& surfels)
{
    constexpr double kOutside = 0.01;
    std::vector<size_t> order(surfels.count());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return surfels.position[a].y < surfels.position[b].y;
    });
    const double all = std::accumulate(surfels.area.begin(), surfels.area.end(), 0.0);
    Heights heights;
    double below = 0.0;
    for (const size_t s : order) {
        if (below <= kOutside * all) heights.floor = surfels.position[s].y;
        if (below <= (1.0 - kOutside) * all) heights.ceiling = surfels.position[s].y;
        below += surfels.area[s];
    }
    return heights;
}

const char* kindOf(const Candidate& piece, const Heights& room)
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
class Pieces
{
public:
    Pieces(const Texels& texels, Progress& progress)
        : heights_(heightsOf(texels.surfels)), reach_(kReach * texels.surfels.size),
          pieces_(piecesOf(texels, progress))
    {
        for (const Candidate& piece : pieces_) around_.push_back(boundsAround(piece, reach_));
    }

    [[nodiscard]] int count() const { return static_cast<int>(pieces_.size()); }

    /// Labels the fixtures that have none, as far as they lie on a piece; each piece's is given
    /// once. Numbers begin with `first`.
    void label(std::span<const std::vector<ClippedPatch>> surfaces, int first,
               std::vector<FixtureLabel>& labels) const;

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

    Heights heights_;
    float reach_; // m
    std::vector<Candidate> pieces_;
    std::vector<Bounds> around_; // of pieces: what is further is not near one
};

/// The piece with the patch nearest to a place; their count where none is near.
size_t Pieces::nearestTo(glm::vec3 place) const
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

void Pieces::addCovers(std::span<const ClippedPatch> surface, size_t fixture,
                       std::vector<Cover>& covers) const
{
    std::vector<float> area(pieces_.size() + 1, 0.0f);
    for (const ClippedPatch& patch : surface) area[nearestTo(patch.position)] += patch.area;
    for (size_t p = 0; p < pieces_.size(); ++p)
        if (area[p] > kLeastCovered * pieces_[p].area) covers.push_back({fixture, p, area[p]});
}

void Pieces::label(std::span<const std::vector<ClippedPatch>> surfaces, int first,
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
        label.id = first + static_cast<int>(cover.piece);
        label.name = fmt::format("{} {}", kindOf(pieces_[cover.piece], heights_), label.id);
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

std::vector<FixtureLabel> labelsOf(const Texels& texels,
                                   std::span<const std::vector<ClippedPatch>> surfaces,
                                   Progress& progress)
{
    std::vector<FixtureLabel> labels(surfaces.size());
    if (labels.empty()) return labels;
    const Scan coarse =
        coarseCopyOf(*texels.scan, kCoarseSide, [&](size_t page) { texels.letGo(page); });
    const Texels coarseTexels = rasterizeAtlas(coarse, progress, {.layered = true});
    const Pieces large(coarseTexels, progress);
    large.label(surfaces, 0, labels);
    if (areAllLabelled(labels)) return labels;
    const Pieces small(texels, progress);
    small.label(surfaces, large.count(), labels);
    int next = large.count() + small.count();
    for (FixtureLabel& label : labels)
        if (label.id < 0) label = {.id = next, .name = fmt::format("lamp {}", next++)};
    return labels;
}

} // namespace relamp
