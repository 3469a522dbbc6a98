#pragma once

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
    /// Each part is as many times `even` as `ratios` says; one that they do not name is just that.
    OutsideLight(glm::vec3 even, // NOLINT(google-explicit-constructor)
                 std::vector<glm::vec3> ratios = {})
        : even_(even), ratios_(std::move(ratios))
    {}

    [[nodiscard]] glm::vec3 operator[](size_t part) const
    {
        return part < ratios_.size() ? even_ * ratios_[part] : even_;
    }
    [[nodiscard]] glm::vec3 even() const { return even_; }
    [[nodiscard]] const std::vector<glm::vec3>& ratios() const { return ratios_; }

    bool operator==(const OutsideLight&) const = default;

private:
    glm::vec3 even_;
    std::vector<glm::vec3> ratios_;
};

/// Parts of these radiances. Even is the mean by the `shares` of all light that parts let in.
inline OutsideLight outsideOf(std::span<const glm::vec3> parts, std::span<const float> shares)
{
    if (parts.size() == 1) return parts[0];
    glm::vec3 even(0.0f);
    float all = 0.0f;
    for (size_t part = 0; part < parts.size(); ++part) {
        even += shares[part] * parts[part];
        all += shares[part];
    }
    even = all > 0.0f ? even / all : parts[0];
    std::vector<glm::vec3> ratios(parts.size(), glm::vec3(1.0f));
    for (size_t part = 0; part < parts.size(); ++part)
        for (int c = 0; c < 3; ++c)
            if (even[c] > 0.0f) ratios[part][c] = parts[part][c] / even[c];
    return {even, std::move(ratios)};
}

} // namespace relamp
