#pragma once

#include "lights/candidates.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <array>
#include <cstddef>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// The sides of the box along the walls around a scan, cut into squares of about 0.5 m: what rays
/// leave a scan through.
class OpeningSquares
{
public:
    /// The box holds all but the scan's crumbs.
    explicit OpeningSquares(const Surfels& surfels);

    [[nodiscard]] size_t count() const { return count_; }

    /// The square that a ray leaves through. One from outside of the box begins at its side.
    [[nodiscard]] size_t leftBy(const Ray& ray) const;

    /// What may stand before a square, unseen.
    [[nodiscard]] Candidate operator[](size_t square) const;

    struct Point
    {
        glm::vec3 position; // m
        glm::vec3 normal;   // into the room
        float area;         // m^2, of its square
    };
    /// Of a square; `at` in [0, 1)^2.
    [[nodiscard]] Point pointOf(size_t square, glm::vec2 at) const;

    [[nodiscard]] size_t sideOf(size_t square) const;
    static bool isUpright(size_t side) { return side / 2 != 1; }

    /// Calls `visit(square, other)` for all squares beside each other on one side.
    template<class Visit>
    void forEachBeside(const Visit& visit) const
    {
        for (size_t square = 0; square < count_; ++square) {
            const size_t side = sideOf(square);
            const auto columns = static_cast<size_t>(counts_[side][0]);
            const size_t end = first_[side] + columns * static_cast<size_t>(counts_[side][1]);
            if ((square - first_[side] + 1) % columns != 0) visit(square, square + 1);
            if (square + columns < end) visit(square, square + columns);
        }
    }

private:
    /// The two axes along a side.
    static std::pair<int, int> across(int side) { return {(side / 2 + 1) % 3, (side / 2 + 2) % 3}; }
    void makeBox(const Surfels& surfels);

    WallFrame frame_;
    glm::vec3 low_{0.0f}; // of the box, in the frame
    glm::vec3 high_{0.0f};
    std::array<std::array<int, 2>, 6> counts_{};
    std::array<size_t, 6> first_{};
    size_t count_ = 0;
};

} // namespace relamp
