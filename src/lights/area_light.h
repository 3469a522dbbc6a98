#pragma once

#include "lights/surfel_radiance.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A lamp as something that points can be sampled on: its burnt-out patches, and where in their
/// order an area is reached.
class AreaLight
{
public:
    explicit AreaLight(std::vector<ClippedPatch> patches);

    [[nodiscard]] float area() const { return areaUpTo_.empty() ? 0.0f : areaUpTo_.back(); }
    /// Patch at which `share` (0..1) of the area is reached.
    [[nodiscard]] const ClippedPatch& at(float share) const;
    [[nodiscard]] std::span<const ClippedPatch> patches() const { return patches_; }
    [[nodiscard]] glm::vec3 centre() const { return centre_; }
    /// Of the sphere around `centre` that holds all.
    [[nodiscard]] float radius() const { return radius_; }

private:
    std::vector<ClippedPatch> patches_;
    std::vector<float> areaUpTo_;
    std::vector<uint32_t> firstOfShare_; // where the search for a share starts, evenly over 0..1
    glm::vec3 centre_{0.0f};
    float radius_ = 0.0f;
};

inline const ClippedPatch& AreaLight::at(float share) const
{
    const auto steps = static_cast<float>(firstOfShare_.size());
    const auto step = std::min(static_cast<size_t>(share * steps), firstOfShare_.size() - 1);
    size_t index = firstOfShare_[step];
    const float wanted = share * area();       // no more than the last
    for (int likely = 0; likely < 2; ++likely) // most need no more, and this is no branch
        index += areaUpTo_[index] < wanted ? size_t{1} : size_t{0};
    while (areaUpTo_[index] < wanted) ++index;
    return patches_[index];
}

} // namespace relamp
