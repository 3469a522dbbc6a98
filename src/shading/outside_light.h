#pragma once

#include "base/radiometry.shared.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Radiance of what lies beyond a scan, by the parts of it that HitTarget::part() names.
class OutsideLight
{
public:
    OutsideLight() : OutsideLight(glm::vec3(0.0f)) {}
    /// The same everywhere.
    OutsideLight(glm::vec3 even) : parts_{even} {} // NOLINT(google-explicit-constructor)
    /// At least one; what they do not name is as the last.
    explicit OutsideLight(std::vector<glm::vec3> parts) : parts_(std::move(parts)) {}

    [[nodiscard]] glm::vec3 operator[](size_t part) const
    {
        return part < parts_.size() ? parts_[part] : parts_.back();
    }
    [[nodiscard]] std::span<const glm::vec3> parts() const { return parts_; }

    bool operator==(const OutsideLight&) const = default;

private:
    std::vector<glm::vec3> parts_;
};

/// The even radiance that lets as much light in: the mean by parts' `shares` of that.
inline glm::vec3 evenOf(const OutsideLight& outside, std::span<const float> shares)
{
    if (outside.parts().size() == 1) return outside[0];
    glm::vec3 sum(0.0f);
    float all = 0.0f;
    for (size_t part = 0; part < shares.size(); ++part) {
        sum += shares[part] * outside[part];
        all += shares[part];
    }
    return all > 0.0f ? sum / all : outside[0];
}

/// `outside`, whose even radiance is `even`, as bright as `wanted`; its parts keep their ratios.
inline OutsideLight scaled(const OutsideLight& outside, glm::vec3 even, glm::vec3 wanted)
{
    if (wanted == even) return outside;
    std::vector<glm::vec3> parts(outside.parts().begin(), outside.parts().end());
    for (glm::vec3& part : parts)
        for (int c = 0; c < 3; ++c)
            part[c] = even[c] > 0.0f ? part[c] * wanted[c] / even[c] : wanted[c];
    return OutsideLight(std::move(parts));
}

} // namespace relamp
