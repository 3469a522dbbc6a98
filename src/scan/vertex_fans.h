#pragma once

#include "relamp/scan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// The triangles around every place of a mesh. Vertices that coincide are one, so that a UV seam
/// cuts no fan.
class VertexFans
{
public:
    explicit VertexFans(const Mesh& mesh);

    /// Triangles around a corner (0..2) of a triangle, itself among them; none where more meet than
    /// on any surface, which keeps the cost of visiting them linear.
    [[nodiscard]] std::span<const uint32_t> around(size_t triangle, int corner) const
    {
        const uint32_t place = placeOf_[3 * triangle + static_cast<size_t>(corner)];
        const std::span fan(triangles_.data() + first_[place], first_[place + 1] - first_[place]);
        return fan.size() > kMost ? std::span<const uint32_t>() : fan;
    }

private:
    static constexpr size_t kMost = 64;

    std::vector<uint32_t> placeOf_; // of corners: the lowest vertex that lies there
    std::vector<uint32_t> first_;   // of places, and one more
    std::vector<uint32_t> triangles_;
};

} // namespace relamp
