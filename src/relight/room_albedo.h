#pragma once

#include "relamp/image.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The albedo of a room as light meets it, 0..1.
///
/// Where confidence is 0 the albedo is that of the surface around; but a wall that is burnt out is
/// no darker than white needs it to be under the light of the scan, which is what delight wrote.
class RoomAlbedo
{
public:
    /// `albedo` and `confidence` as in DelitRoom, `isBurntOut` as SurfelRadiance::isClipped; the
    /// arguments must outlive this.
    RoomAlbedo(const Texels& texels, std::span<const Image> albedo,
               std::span<const Image> confidence, std::span<const std::vector<bool>> isBurntOut);

    /// Of surfels: mean of the texels that can be trusted, or are burnt out; where these are few,
    /// what the surface around has.
    [[nodiscard]] const std::vector<glm::vec3>& ofSurfels() const { return ofSurfels_; }
    [[nodiscard]] glm::vec3 ofTexel(size_t page, uint32_t pixel, uint32_t surfel) const;

private:
    struct Sum;

    void join(const Surfels& surfels, std::span<const Sum> known, std::span<const Sum> burntOut);
    [[nodiscard]] bool isKnown(size_t page, uint32_t pixel) const;
    [[nodiscard]] glm::vec3 ownOf(size_t page, uint32_t pixel) const;

    std::span<const std::vector<bool>> isBurntOut_;
    std::vector<Radiance> albedo_;
    std::vector<Radiance> confidence_; // 0: a guess
    std::vector<glm::vec3> around_;    // of surfels, without what is burnt out
    std::vector<glm::vec3> ofSurfels_;
};

} // namespace relamp
