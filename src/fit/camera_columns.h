#pragma once

#include "fit/light_fit.h"
#include "image/response.h"
#include "relamp/camera_model.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Log odds against what hardly a scan has: an exposure that does not drift, a mesh through which
/// no light leaks.
inline constexpr double kHardlyEverNats = 8.0;

/// Radiance: local tone mapping lifts nothing darker.
inline constexpr float kDarkestBase = 0.01f;

/// Times N, that pairs are worth for the evidence of a drift; as many times more where there is
/// one, for what errs alike over metres is gone then, and no more than N where there is none.
inline constexpr double kGainWorth = 4.0;

/// Slope of an inverse response, and exponent of a tone, at least.
inline constexpr double kFlattestSlope = 0.4;

/// What places of a scan show in its file, and where they lie.
struct TexturePlaces
{
    std::span<const glm::vec3> texture; // linear
    std::span<const glm::vec3> position;
};

/// The slopes of the response, less 1, as unknowns beside the light.
CameraColumns columnsOf(const Response& known, const TexturePlaces& places);
/// All of them as one, which is no unknown but what is expected of it.
CameraColumns evenSlope(const CameraColumns& slopes);
/// That of a straight camera, less 1, where the mesh is `open`, 0..1: what leaks to dark places
/// looks like contrast.
double flattenedBy(double open);
/// `share`, 0..1, of the way from a straight one.
Response responseOf(std::span<const double> coefficients, double share = 1.0);
/// Whether such a camera made what is bright flatter than is usual, as fused brackets do. Leaks,
/// and what of a drift lies between knots, look like contrast in the dark alone, and of a deeper
/// kind.
bool isFlattening(std::span<const double> coefficients);
/// By how much that may be wrong where a curve is `likely`, 0..1, and else it is straight: what the
/// pairs leave open of a curve, and that it may be the other. The slopes come first in
/// `fit.camera`.
SlopeCovariance doubtOfResponse(const LightEstimate& fit, double likely, double share);

/// What local tone mapping leaves of the brightness around each place, as one unknown beside the
/// light: 1 / exponent - 1. `around`: logarithms of that brightness in the texture, without
/// response.
CameraColumns columnsOf(const LocalTone& known, const Gain& around, const TexturePlaces& places);
LocalTone localToneOf(const Gain& around, double coefficient);

/// Both as unknowns of one fit, the first ahead, which alone may have slopes.
CameraColumns together(const CameraColumns& first, const CameraColumns& second);

/// A lattice for the brightness around places, fine enough for local tone mapping.
Gain toneLatticeOver(std::span<const glm::vec3> position);

/// A gain of 1 over these places; without knots where they lie too close together for one.
Gain evenGainOver(std::span<const glm::vec3> position);
/// Likewise one a room, which has one knot where its places lie so; none where all do. `positions`:
/// of the places of each.
std::vector<Gain> evenGainsOver(std::span<const std::vector<glm::vec3>> positions);

/// One with knots twice as far apart, which leaves a contrast to the contrast; also over places
/// that have no gain.
Gain coarseGainOver(std::span<const glm::vec3> position);

/// The logarithms of the gain's knots as unknowns beside the light.
CameraColumns columnsOf(const Gain& known, const TexturePlaces& places);
Gain gainOf(Gain lattice, std::span<const double> coefficients);
/// How likely a camera drifted, by the evidence for `drift` in nats.
double likelihoodByEvidence(double drift);
/// How many times N pairs are worth beside that where exposure is `likely`, 0..1, to have drifted:
/// where it has not, what looks like it are errors of the light.
double worthOfGain(double likely);

/// Of a lattice's knots, count * count: each within `spread` of 0, and within `step` of those
/// beside it.
std::vector<double> precisionOf(const Gain& gain, double spread, double step);

} // namespace relamp
