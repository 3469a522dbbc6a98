#pragma once

#include "fit/stray.shared.h"
#include "lights/surfel_radiance.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

#include <array>

namespace relamp
{

/// Light that rays bring to dark places of a scan and that never got there in the room.
///
/// A reconstruction has gaps, and what is thin is missing from it. What comes through them is
/// little beside the light of an open wall and much in a dark corner, so the share of it is a curve
/// over shading; a scan without gaps has none.
class StrayLight
{
public:
    static constexpr int kKnots = kStrayKnots;
    static constexpr float kFirst = kFirstStrayKnot;

    /// `octaves[i]` >= 0: by how many octaves shading of 2^(kFirst + i) is too high.
    explicit StrayLight(const std::array<float, kKnots>& octaves = {}) : octaves_(octaves) {}

    /// What is left of this shading (luminance of irradiance / pi) without its stray share: 0..1.
    [[nodiscard]] float kept(float shading) const;
    [[nodiscard]] const std::array<float, kKnots>& octaves() const { return octaves_; }
    [[nodiscard]] bool isNone() const { return octaves_ == std::array<float, kKnots>{}; }

private:
    std::array<float, kKnots> octaves_;
};

/// Finds the curve by pairs of places of one material, of which one is darker: where shading is
/// right, albedo is the same. Nothing is taken off what is lit better than half of the places.
StrayLight fitStray(const Texels& texels, const SurfelRadiance& radiance,
                    const TexelShading& shade);

/// The shading without it, direct and indirect by the same share; the irradiance of places.
TexelShading withoutStray(TexelShading shade, const StrayLight& stray);
std::vector<glm::vec3> withoutStray(std::vector<glm::vec3> irradiance, const StrayLight& stray);

} // namespace relamp
