#include "fit/camera_columns.h"

#include "base/radiometry.shared.h"
#include "image/response.h"
#include "scan/gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <Eigen/LU>

namespace relamp
{
namespace
{

// Of measured responses (Grossberg and Nayar 2004) and what raw developers apply: a contrast of 0.6
// to 1.5, and shoulders and toes beside it.
constexpr double kContrastSpread = 0.25; // of a slope, all together
constexpr double kShapeSpread = 0.2;     // of a slope by itself
constexpr double kFlattest = 0.4;        // slope
constexpr double kSteepest = 3.0;        // likewise
constexpr float kKnotSpacing = 1.2f;     // m: exposure drifts over metres
constexpr int kMostKnots = 120;
double kGainSpread = getenv("RELAMP_GS") ? atof(getenv("RELAMP_GS")) : 0.3;     // log: of the gain about its mean
double kGainStep = getenv("RELAMP_GD") ? atof(getenv("RELAMP_GD")) : 0.12;      // log: of the gain from knot to knot

size_t slopesOf(const CameraModel& model)
{
    return model.response ? Response::kKnots : 0;
}

size_t countOf(const CameraModel& model)
{
    return slopesOf(model) + (model.gain ? model.gain->log.size() : 0);
}

void addPrecisionOfSlopes(Eigen::MatrixXd& precision)
{
    constexpr auto n = static_cast<Eigen::Index>(Response::kKnots);
    Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Constant(n, n, kContrastSpread * kContrastSpread);
    covariance.diagonal().array() += kShapeSpread * kShapeSpread;
    precision.topLeftCorner(n, n) = covariance.inverse();
}

void addPrecisionOfGain(const Gain& gain, Eigen::Index first, Eigen::MatrixXd& precision)
{
    const std::array<int, 3> counts{gain.countX, gain.countY, gain.countZ};
    const std::array<int, 3> strides{1, gain.countX, gain.countX * gain.countY};
    const double step = 1.0 / (kGainStep * kGainStep);
    for (int knot = 0; knot < static_cast<int>(gain.log.size()); ++knot) {
        const Eigen::Index i = first + knot;
        precision(i, i) += 1.0 / (kGainSpread * kGainSpread);
        for (size_t axis = 0; axis < 3; ++axis) {
            if (knot / strides[axis] % counts[axis] + 1 >= counts[axis]) continue;
            const Eigen::Index j = i + strides[axis];
            precision(i, i) += step;
            precision(j, j) += step;
            precision(i, j) -= step;
            precision(j, i) -= step;
        }
    }
}

std::vector<double> precisionOf(const CameraModel& model)
{
    const auto n = static_cast<Eigen::Index>(countOf(model));
    Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(n, n);
    if (model.response) addPrecisionOfSlopes(precision);
    if (model.gain)
        addPrecisionOfGain(*model.gain, static_cast<Eigen::Index>(slopesOf(model)), precision);
    return {precision.data(), precision.data() + precision.size()};
}

/// Means over the channels by what each brings to the luminance.
void addSlopes(const Response& known, glm::vec3 texture, std::span<float> bend,
               std::span<float> slope)
{
    constexpr glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float weight = weights[c] * known(texture[c]);
        const auto bendOf = bendAt(texture[c]);
        const auto slopeOf = slopeAt(texture[c]);
        for (size_t k = 0; k < Response::kKnots; ++k) {
            bend[k] += weight * bendOf[k];
            slope[k] += weight * slopeOf[k];
        }
        sum += weight;
    }
    for (size_t k = 0; k < Response::kKnots; ++k) {
        bend[k] /= std::max(sum, 1e-9f);
        slope[k] /= std::max(sum, 1e-9f);
    }
}

/// Light that is gathered does not change with the camera here, so no column changes the mean.
void takeMeansOut(size_t count, std::vector<float>& bend)
{
    std::vector<double> mean(count, 0.0);
    const size_t rows = bend.size() / std::max<size_t>(count, 1);
    for (size_t i = 0; i < bend.size(); ++i) mean[i % count] += static_cast<double>(bend[i]);
    for (double& m : mean) m /= static_cast<double>(std::max<size_t>(rows, 1));
    for (size_t i = 0; i < bend.size(); ++i) bend[i] -= static_cast<float>(mean[i % count]);
}

} // namespace

std::optional<Gain> latticeOver(std::span<const glm::vec3> positions)
{
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (const glm::vec3 p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    Gain gain;
    glm::ivec3 counts;
    for (gain.spacing = kKnotSpacing;; gain.spacing *= 1.1f) {
        counts = glm::ivec3(glm::ceil((high - low) / gain.spacing)) + 1;
        if (counts.x * counts.y * counts.z <= kMostKnots) break;
    }
    if (std::max({counts.x, counts.y, counts.z}) < 3) return std::nullopt;
    gain.origin = 0.5f * (low + high - gain.spacing * glm::vec3(counts - 1));
    gain.countX = counts.x;
    gain.countY = counts.y;
    gain.countZ = counts.z;
    gain.log.assign(static_cast<size_t>(counts.x * counts.y * counts.z), glm::vec3(0.0f));
    return gain;
}

CameraColumns columnsOf(const CameraModel& known, std::span<const glm::vec3> texture,
                        std::span<const glm::vec3> positions)
{
    const size_t n = countOf(known);
    const size_t slopes = slopesOf(known);
    CameraColumns columns;
    if (known.response)
        for (const float slope : known.response->slope)
            columns.known.push_back(static_cast<double>(slope) - 1.0);
    if (known.gain)
        for (const glm::vec3 log : known.gain->log)
            columns.known.push_back(static_cast<double>(log.g));
    columns.bend.assign(texture.size() * n, 0.0f);
    columns.slope.assign(texture.size() * n, 0.0f);
    columns.slopeKnown.assign(texture.size(), 1.0f);
    for (size_t i = 0; i < texture.size(); ++i) {
        const std::span<float> bend(&columns.bend[i * n], n);
        const std::span<float> slope(&columns.slope[i * n], n);
        if (known.response) {
            addSlopes(*known.response, texture[i], bend, slope);
            columns.slopeKnown[i] = 0.0f;
            for (size_t k = 0; k < slopes; ++k)
                columns.slopeKnown[i] += known.response->slope[k] * slope[k];
        }
        if (!known.gain) continue;
        const GainWeights weights = weightsAt(*known.gain, positions[i]);
        for (size_t k = 0; k < 8; ++k) bend[slopes + weights.knot[k]] -= weights.part[k];
    }
    takeMeansOut(n, columns.bend);
    columns.precision = precisionOf(known);
    return columns;
}

CameraModel withCoefficients(CameraModel model, std::span<const double> coefficients)
{
    if (model.response)
        for (size_t k = 0; k < Response::kKnots; ++k)
            model.response->slope[k] =
                static_cast<float>(std::clamp(1.0 + coefficients[k], kFlattest, kSteepest));
    if (model.gain)
        for (size_t k = 0; k < model.gain->log.size(); ++k)
            model.gain->log[k] =
                glm::vec3(static_cast<float>(coefficients[slopesOf(model) + k]));
    return model;
}

} // namespace relamp
