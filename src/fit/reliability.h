#pragma once

#include "image/response.h"
#include "shading/gathered_light.h"
#include "shading/hit_lists.h"

#include <span>
#include <vector>

namespace relamp
{

/// Of the light in the middle of all places: lost anywhere, or let in, by few rays and a whole
/// mesh.
inline constexpr float kLostLight = 0.025f;

/// The same of a mesh that is `gaps` likely to have gaps, 0..1, as Lights: a reconstruction, whose
/// contacts stand open, lets in twice as much.
inline float lostLight(float gaps)
{
    return (1.0f + gaps) * kLostLight;
}

/// Of any light, where nothing else speaks against it, as a share: standard deviation.
inline constexpr float kAlwaysUnsure = 0.05f;

/// By how much the light found on a surfel may be wrong: variances of its logarithm, by cause.
struct LightVariance
{
    float outside = 0.0f; // it comes from what the scan does not show
    float backs = 0.0f;   // it comes from backs of surfaces, of which the texture says nothing
    float edges = 0.0f;   // a shadow's edge is near
    float dark = 0.0f;    // there is so little that what was let in anywhere counts

    [[nodiscard]] float ofMesh() const
    {
        return backs + edges + dark + kAlwaysUnsure * kAlwaysUnsure;
    }
    [[nodiscard]] float total() const { return outside + ofMesh(); }
};

/// What of the light at a place was not let in, 0.5..1, where `leak` of it is in the mean: leaks
/// are exponential, and no more than all there is.
double shareBesideLeak(double leak);

/// That of the light found on a surfel, as far as its variance tells. `gaps`: as lostLight().
float shareExpected(const LightVariance& variance, float gaps);

/// Before anything was corrected. `hits`: of all fronts, which come first in them. One entry a
/// surfel; `light.spread` may be empty where a solver does not know it.
std::vector<LightVariance> varianceOf(const HitLists& hits, const SurfelLighting& light);

/// What is left of them after the light was corrected by `lit` times; empty: it was not.
std::vector<float> varianceLeft(std::span<const LightVariance> variance,
                                std::span<const float> lit);

/// Of the logarithm of radiance, one a surfel, where a camera's response is known as well as
/// `slopes` say. What makes all of the room as much brighter or darker is left out. `texture`:
/// linear, what surfels show; `area`: over which they do.
std::vector<float> varianceOfResponse(std::span<const glm::vec3> texture,
                                      std::span<const float> area, const SlopeCovariance& slopes);

/// How far the shading of a surfel can be believed: factors of a probability, 0..1, where 1 is no
/// doubt.
struct SurfelTrust
{
    float seen = 1.0f;   // falls by what comes from outside
    float front = 1.0f;  // by what comes from backs
    float edges = 1.0f;  // by shadows' edges, corrections, the camera and all else
    float proven = 1.0f; // falls, everywhere, where albedo is no better than the scan
};

/// The product of `seen`, `front` and `edges` is the probability that albedo is right to within
/// 15 % after the light was corrected by `lit` times and the radiance has the variance `ofCamera`,
/// one a surfel; empty: nothing was, or 0. Each cause has its share of the logarithm.
std::vector<SurfelTrust> reliabilityOf(std::span<const LightVariance> variance,
                                       std::span<const float> lit,
                                       std::span<const float> ofCamera = {});

} // namespace relamp
