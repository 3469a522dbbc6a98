#include "shading/opening_squares.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kBeyond = 0.2f; // m behind the outermost surface that an unseen one may stand
constexpr float kSquare = 0.5f; // m
constexpr float kMostSquares =
    256.0f; // along a side: in a landscape, or a scan in millimetres, they are larger
constexpr int kAcross = 5;        // patches of a square
constexpr double kCrumbs = 0.003; // of a scan's surface that may lie beyond its room

} // namespace

OpeningSquares::OpeningSquares(const Surfels& surfels) : frame_(surfels.grid.frame())
{
    makeBox(surfels);
    const glm::vec3 extent = high_ - low_;
    const float longest = std::max({extent.x, extent.y, extent.z});
    const float size = std::max(kSquare, longest / kMostSquares);
    for (size_t side = 0; side < first_.size(); ++side) {
        const auto [u, v] = across(static_cast<int>(side));
        for (const int axis : {u, v})
            counts_[side][axis == u ? 0 : 1] =
                std::max(static_cast<int>(std::lround(extent[axis] / size)), 1);
        first_[side] = count_;
        count_ += static_cast<size_t>(counts_[side][0]) * static_cast<size_t>(counts_[side][1]);
    }
}

void OpeningSquares::makeBox(const Surfels& surfels)
{
    const double all = std::accumulate(surfels.area.begin(), surfels.area.end(), 0.0);
    std::vector<glm::vec3> position(surfels.count());
    for (size_t s = 0; s < position.size(); ++s) position[s] = frame_.fromScan(surfels.position[s]);
    forEach(3, [&](size_t a) {
        const auto axis = static_cast<int>(a);
        std::vector<std::pair<float, float>> heights; // and areas
        for (size_t s = 0; s < position.size(); ++s)
            heights.emplace_back(position[s][axis], surfels.area[s]);
        std::sort(heights.begin(), heights.end());
        double below = 0.0;
        for (const auto& [height, area] : heights) {
            if (below <= kCrumbs * all) low_[axis] = height;
            if (below <= (1.0 - kCrumbs) * all) high_[axis] = height;
            below += static_cast<double>(area);
        }
    });
    low_ -= kScanError;
    high_ += kScanError;
}

size_t OpeningSquares::leftBy(const Ray& ray) const
{
    const glm::vec3 origin = glm::clamp(frame_.fromScan(ray.origin), low_, high_);
    const glm::vec3 direction = frame_.fromScan(ray.direction);
    float nearest = std::numeric_limits<float>::max();
    int side = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) continue;
        const bool isUp = direction[axis] > 0.0f;
        const float distance = ((isUp ? high_[axis] : low_[axis]) - origin[axis]) / direction[axis];
        if (distance >= nearest) continue;
        nearest = distance;
        side = 2 * axis + (isUp ? 1 : 0);
    }
    const glm::vec3 at = (origin + nearest * direction - low_) / (high_ - low_);
    const auto [u, v] = across(side);
    const auto& counts = counts_[static_cast<size_t>(side)];
    const auto place = [](float share, int of) {
        return static_cast<size_t>(
            std::clamp(static_cast<int>(share * static_cast<float>(of)), 0, of - 1));
    };
    return first_[static_cast<size_t>(side)] +
           place(at[v], counts[1]) * static_cast<size_t>(counts[0]) + place(at[u], counts[0]);
}

OpeningSquares::Point OpeningSquares::pointOf(size_t square, glm::vec2 at) const
{
    const size_t side = sideOf(square);
    const size_t index = square - first_[side];
    const auto [u, v] = across(static_cast<int>(side));
    const auto axis = static_cast<int>(side / 2);
    const glm::vec3 extent = high_ - low_;
    const float width = extent[u] / static_cast<float>(counts_[side][0]);
    const float height = extent[v] / static_cast<float>(counts_[side][1]);
    const auto column = static_cast<float>(index % static_cast<size_t>(counts_[side][0]));
    const auto row = static_cast<float>(index / static_cast<size_t>(counts_[side][0]));
    glm::vec3 position(0.0f);
    position[axis] = side % 2 != 0 ? high_[axis] : low_[axis];
    position[u] = low_[u] + (column + at.x) * width;
    position[v] = low_[v] + (row + at.y) * height;
    glm::vec3 normal(0.0f);
    normal[axis] = side % 2 != 0 ? -1.0f : 1.0f;
    return {frame_.toScan(position), frame_.toScan(normal), width * height};
}

Candidate OpeningSquares::operator[](size_t square) const
{
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const glm::vec2 at((static_cast<float>(i % kAcross) + 0.5f) / kAcross,
                           (static_cast<float>(i / kAcross) + 0.5f) / kAcross);
        const auto [position, normal, area] = pointOf(square, at);
        patches.push_back({.position = position - kBeyond * normal,
                           .normal = normal,
                           .area = area / static_cast<float>(kAcross * kAcross),
                           .surfel = Surfels::kNone});
    }
    return candidateOf(std::move(patches));
}

size_t OpeningSquares::sideOf(size_t square) const
{
    size_t side = 5;
    while (first_[side] > square) --side;
    return side;
}

} // namespace relamp
