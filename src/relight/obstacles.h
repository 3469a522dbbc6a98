#pragma once

#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// What stops light on its way: the scan's surface, but for window openings where it comes from
/// outside. The arguments must outlive this. Thread safe.
class Obstacles
{
public:
    /// `isOpening` marks surfels, `isClipped` [page][pixel] what is burnt out of them; light that
    /// is burnt out in a surfel of an opening goes through. Without openings everything stops
    /// light.
    Obstacles(const Texels& texels, const RayScene& scene, std::span<const uint8_t> isOpening,
              std::span<const std::vector<bool>> isClipped)
        : texels_(texels), scene_(scene), isOpening_(isOpening), isClipped_(isClipped)
    {}

    /// blocked[i] is not 0 where rays[i] does not come through.
    void blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const;

private:
    [[nodiscard]] bool isBlocked(Ray ray) const;

    const Texels& texels_;
    const RayScene& scene_;
    std::span<const uint8_t> isOpening_; // empty: none
    std::span<const std::vector<bool>> isClipped_;
};

} // namespace relamp
