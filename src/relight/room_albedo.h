#pragma once

#include "relamp/image.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The albedo of a room as light meets it.
class RoomAlbedo
{
public:
    /// `albedo` and `confidence` as in DelitRoom; the arguments must outlive this.
    RoomAlbedo(const Texels& texels, std::span<const Image> albedo,
               std::span<const Image> confidence);

    /// Of surfels: mean of the texels that can be trusted; where these are few, what the surface
    /// around has. 0..1.
    [[nodiscard]] const std::vector<glm::vec3>& ofSurfels() const { return ofSurfels_; }
    /// Of a texel, 0..1; where it is a guess, that of its surfel.
    [[nodiscard]] glm::vec3 ofTexel(size_t page, uint32_t pixel, uint32_t surfel) const;

private:
    [[nodiscard]] bool isKnown(size_t page, uint32_t pixel) const;

    std::span<const Image> confidence_;
    std::vector<Radiance> albedo_;
    std::vector<glm::vec3> ofSurfels_;
};

} // namespace relamp
