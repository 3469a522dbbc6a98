#include "fit/openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kBeyond = 0.2f; // m behind the outermost surface that an unseen one may stand
constexpr float kSquare = 0.5f; // m
constexpr size_t kMost = 128;
constexpr int kAcross = 5;             // patches of a square
constexpr double kLeastShare = 3e-4;   // of all light that could reach surfaces from there
constexpr double kLeastOutside = 0.01; // of it that all openings together let in
constexpr double kCrumbs = 0.003;      // of a scan's surface that may lie beyond its room

struct Box
{
    glm::vec3 low{0.0f};
    glm::vec3 high{0.0f};
};

/// That holds a scan but for its crumbs, and what is just beyond.
Box boxAround(const Surfels& surfels)
{
    const double all = std::accumulate(surfels.area.begin(), surfels.area.end(), 0.0);
    Box box;
    std::vector<uint32_t> order(surfels.count());
    std::iota(order.begin(), order.end(), 0u);
    for (int axis = 0; axis < 3; ++axis) {
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return std::pair(surfels.position[a][axis], a) <
                   std::pair(surfels.position[b][axis], b);
        });
        double below = 0.0;
        for (const uint32_t s : order) {
            if (below <= kCrumbs * all) box.low[axis] = surfels.position[s][axis];
            if (below <= (1.0 - kCrumbs) * all) box.high[axis] = surfels.position[s][axis];
            below += static_cast<double>(surfels.area[s]);
        }
    }
    box.low -= kBeyond;
    box.high += kBeyond;
    return box;
}

/// The sides of a box, cut into squares.
class Squares
{
public:
    Squares(const Box& box, float size) : box_(box)
    {
        size_t first = 0;
        for (int side = 0; side < 6; ++side) {
            const auto [u, v] = across(side);
            for (const int axis : {u, v})
                counts_[static_cast<size_t>(side)][axis == u ? 0 : 1] = std::max(
                    static_cast<int>(std::lround((box.high[axis] - box.low[axis]) / size)), 1);
            first_[static_cast<size_t>(side)] = first;
            first += static_cast<size_t>(counts_[static_cast<size_t>(side)][0]) *
                     static_cast<size_t>(counts_[static_cast<size_t>(side)][1]);
        }
        count_ = first;
    }

    [[nodiscard]] size_t count() const { return count_; }

    /// The square that a ray leaves through; count() for one from outside of the box.
    [[nodiscard]] size_t leftBy(const Ray& ray) const
    {
        float nearest = std::numeric_limits<float>::max();
        int side = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (ray.origin[axis] < box_.low[axis] || ray.origin[axis] > box_.high[axis])
                return count_;
            if (ray.direction[axis] == 0.0f) continue;
            const bool isUp = ray.direction[axis] > 0.0f;
            const float distance = ((isUp ? box_.high[axis] : box_.low[axis]) - ray.origin[axis]) /
                                   ray.direction[axis];
            if (distance >= nearest) continue;
            nearest = distance;
            side = 2 * axis + (isUp ? 1 : 0);
        }
        const glm::vec3 at =
            (ray.origin + nearest * ray.direction - box_.low) / (box_.high - box_.low);
        const auto [u, v] = across(side);
        const auto& counts = counts_[static_cast<size_t>(side)];
        const auto place = [](float share, int of) {
            return static_cast<size_t>(
                std::clamp(static_cast<int>(share * static_cast<float>(of)), 0, of - 1));
        };
        return first_[static_cast<size_t>(side)] +
               place(at[v], counts[1]) * static_cast<size_t>(counts[0]) + place(at[u], counts[0]);
    }

    [[nodiscard]] Candidate operator[](size_t square) const
    {
        size_t side = 5;
        while (first_[side] > square) --side;
        const size_t at = square - first_[side];
        const auto [u, v] = across(static_cast<int>(side));
        const auto axis = static_cast<int>(side / 2);
        const glm::vec3 size = box_.high - box_.low;
        const float width = size[u] / static_cast<float>(counts_[side][0]);
        const float height = size[v] / static_cast<float>(counts_[side][1]);
        const auto column = static_cast<float>(at % static_cast<size_t>(counts_[side][0]));
        const auto row = static_cast<float>(at / static_cast<size_t>(counts_[side][0]));
        ClippedPatch patch{.area = width * height / static_cast<float>(kAcross * kAcross),
                           .surfel = Surfels::kNone};
        patch.normal[axis] = side % 2 != 0 ? -1.0f : 1.0f;
        patch.position[axis] = side % 2 != 0 ? box_.high[axis] : box_.low[axis];
        std::vector<ClippedPatch> patches;
        for (int i = 0; i < kAcross * kAcross; ++i) {
            const float right = (static_cast<float>(i % kAcross) + 0.5f) / kAcross;
            const float up = (static_cast<float>(i / kAcross) + 0.5f) / kAcross;
            patch.position[u] = box_.low[u] + (column + right) * width;
            patch.position[v] = box_.low[v] + (row + up) * height;
            patches.push_back(patch);
        }
        return candidateOf(std::move(patches));
    }

private:
    /// The two axes along a side.
    static std::pair<int, int> across(int side) { return {(side / 2 + 1) % 3, (side / 2 + 2) % 3}; }

    Box box_;
    std::array<std::array<int, 2>, 6> counts_{};
    std::array<size_t, 6> first_{};
    size_t count_ = 0;
};

/// By squares, of all light that could reach the surfaces of a scan.
std::vector<double> sharesOf(const Squares& squares, const Texels& texels, const HitLists& hits)
{
    const SurfelSites sites(texels);
    std::vector<double> shares(squares.count() + 1, 0.0);
    double all = 0.0;
    for (uint32_t s = 0; s < texels.surfels.count(); ++s) {
        const std::span<const HitTarget> targets = hits.targetsOf(s);
        const auto area = static_cast<double>(texels.surfels.area[s]);
        all += area;
        if (std::none_of(targets.begin(), targets.end(),
                         [](HitTarget target) { return target.isNothing(); }))
            continue;
        const RaysOfSide rays(sites, Side::front(s));
        for (size_t i = 0; i < targets.size(); ++i)
            if (targets[i].isNothing())
                shares[squares.leftBy(rays[i])] += area / static_cast<double>(targets.size());
    }
    shares.pop_back(); // what lies outside
    for (double& share : shares) share /= all;
    return shares;
}

} // namespace

std::vector<Candidate> openingsOf(const Texels& texels, const HitLists& hits)
{
    const Squares squares(boxAround(texels.surfels), kSquare);
    const std::vector<double> shares = sharesOf(squares, texels, hits);
    if (std::accumulate(shares.begin(), shares.end(), 0.0) < kLeastOutside) return {};
    std::vector<size_t> order(shares.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return shares[a] > shares[b]; });
    std::vector<Candidate> openings;
    for (const size_t square : order) {
        if (shares[square] < kLeastShare || openings.size() == kMost) break;
        openings.push_back(squares[square]);
    }
    return openings;
}

} // namespace relamp
