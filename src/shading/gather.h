#pragma once

#include "lights/surfel_radiance.h"
#include "shading/hit_lists.h"
#include "shading/outside_light.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What every side of every surfel sends towards whoever looks at it, lamps left out.
struct RadianceField
{
    std::vector<glm::vec3> plain;   // front, texels that are not burnt out: as the texture has it
    std::vector<glm::vec3> clipped; // front, burnt-out texels that are no lamp: as shown, or more
    std::vector<glm::vec3> back;    // seen from behind: lit by what is there
    OutsideLight outside;           // beyond the scan
    std::vector<uint8_t> shines;    // not 0 where the burnt-out texels of a surfel belong to a lamp
};

/// The field before anything is known: texels as the texture shows them, burnt-out ones, too, none
/// beyond its limit; backs dark, no lamps.
RadianceField fieldOf(const SurfelRadiance& radiance);

/// Light that arrives at the sides of surfels, one entry a list.
struct Gathered
{
    std::vector<glm::vec3> irradiance; // from surfaces that do not shine, and from outside
    std::vector<float> noise;          // standard error of its luminance
    std::vector<float> missed;         // of directions that leave the scan, at radiance 1
};

/// Sums the field over hit lists: K + sum of a M of method.md 5. `lists` are indices into `hits`;
/// all where empty.
Gathered gather(const HitLists& hits, const RadianceField& field,
                std::span<const uint32_t> lists = {});

/// Irradiance of directions that leave the scan for a part of what lies outside, at radiance 1.
struct MissedLight
{
    uint32_t part;
    float irradiance;

    bool operator==(const MissedLight&) const = default;
};

/// M of method.md 5 of a list: of the parts that its rays leave for, in ascending order.
std::vector<MissedLight> missedOf(const HitLists& hits, uint32_t list);

/// Adds `weight` times as much, of parts in ascending order.
void addMissed(std::span<const MissedLight> more, float weight, std::vector<MissedLight>& sum);

/// Gathers a field again and again while its light settles. Plain fronts stay as they are
/// meanwhile, so they are summed once; of the others there are few.
class SettlingGather
{
public:
    SettlingGather() = default;
    /// `lists` as above.
    SettlingGather(const HitLists& hits, const RadianceField& field,
                   std::span<const uint32_t> lists = {});

    /// `field` as the last that was taken but for all that is not plain. Without noise.
    [[nodiscard]] Gathered gather(const RadianceField& field) const;
    /// What is plain is another from now on; `hits` and `lists` are those of the constructor.
    void takePlain(const HitLists& hits, const RadianceField& field,
                   std::span<const uint32_t> lists = {});

private:
    Gathered plain_;
    std::vector<uint32_t> firstOther_{0}; // of lists, and one more
    std::vector<HitTarget> others_;       // burnt-out texels, backs and what lies outside
    std::vector<float> perRay_;           // of lists
};

} // namespace relamp
