#include "fit/camera_columns.h"

#include "base/radiometry.shared.h"
#include "image/response.h"
#include "scan/gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/LU>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace relamp
{
namespace
{

// Of measured responses (Grossberg and Nayar 2004) and what raw developers and exposure fusion
// apply: a contrast of 0.6 to 1.5 in the shadows, less to the light, as film has a shoulder.
constexpr std::array<double, Response::kKnots> kUsualSlopes{0.85, 0.867, 0.935, 1.08, 1.275};
constexpr double kContrastSpread = 0.3; // of all of them
constexpr double kShapeSpread = 0.12;   // of each slope by itself
// Of the contrast, that leaks of a reconstruction take: slopes of straight cameras are 0.72 to
// 0.99.
constexpr double kOpenFlattens = 0.16;
constexpr float kKnotSpacing = 0.8f; // m: automatic exposure drifts over metres
constexpr double kGainSpread = 0.3;  // log: of the gain; automatic exposure by half a stop
constexpr double kGainStep =
    0.25; // log: of the gain from knot to knot; little of it is left at two
constexpr float kToneSpacing = 0.6f; // m: what local tone mapping flattens is larger
constexpr double kToneSpread = 0.4;  // of 1 / exponent - 1: exponents of 0.6 to 1

// Numerics.
constexpr int kMostKnots = 250;       // in a hall they lie farther apart
constexpr int kMostToneKnots = 20000; // in a hall they lie farther apart

double logLuminance(glm::vec3 log) // near 1
{
    return static_cast<double>(luminance(log));
}

std::vector<double> precisionOfSlopes()
{
    constexpr auto n = static_cast<Eigen::Index>(Response::kKnots);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(n, n, kContrastSpread * kContrastSpread);
    covariance.diagonal().array() += kShapeSpread * kShapeSpread;
    const Eigen::MatrixXd precision = covariance.inverse();
    return {precision.data(), precision.data() + precision.size()};
}

/// Means over the channels by what each brings to the luminance.
void addSlopes(const Response& known, glm::vec3 texture, std::span<float> bend,
               std::span<float> slope)
{
    const glm::vec3 brings(luminance({1.0f, 0.0f, 0.0f}), luminance({0.0f, 1.0f, 0.0f}),
                           luminance({0.0f, 0.0f, 1.0f}));
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float weight = brings[c] * known(texture[c]);
        const auto bendOf = bendAt(texture[c]);
        const auto slopeOf = slopeAt(texture[c]);
        for (size_t k = 0; k < Response::kKnots; ++k) {
            bend[k] += weight * bendOf[k];
            slope[k] += weight * slopeOf[k];
        }
        sum += weight;
    }
    for (size_t k = 0; k < Response::kKnots; ++k) {
        bend[k] /= std::max(sum, std::numeric_limits<float>::min());
        slope[k] /= std::max(sum, std::numeric_limits<float>::min());
    }
}

CameraColumns emptyColumns(size_t places, std::vector<double> known)
{
    CameraColumns columns{.known = std::move(known)};
    columns.expected.assign(columns.count(), 0.0);
    columns.bend.assign(places * columns.count(), 0.0f);
    return columns;
}

/// Light that is gathered does not change with the camera here, so no column changes the mean.
void takeMeansOut(CameraColumns& columns)
{
    const size_t count = columns.count();
    std::vector<double> mean(count, 0.0);
    if (count == 0) return;
    const auto places = static_cast<double>(columns.bend.size() / count);
    for (size_t i = 0; i < columns.bend.size(); ++i)
        mean[i % count] += static_cast<double>(columns.bend[i]) / places;
    for (size_t i = 0; i < columns.bend.size(); ++i)
        columns.bend[i] -= static_cast<float>(mean[i % count]);
}

} // namespace

std::vector<double> precisionOf(const Gain& gain, double spread, double step)
{
    const auto n = static_cast<Eigen::Index>(gain.log.size());
    Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(n, n);
    precision.diagonal().array() = 1.0 / (spread * spread);
    const double tie = 1.0 / (step * step);
    Eigen::Index stride = 1;
    for (const int count : gain.count) {
        for (Eigen::Index i = 0; i < n; ++i) {
            if (i / stride % count + 1 >= count) continue;
            const Eigen::Index j = i + stride;
            precision(i, i) += tie;
            precision(j, j) += tie;
            precision(i, j) -= tie;
            precision(j, i) -= tie;
        }
        stride *= count;
    }
    return {precision.data(), precision.data() + precision.size()};
}

CameraColumns columnsOf(const Response& known, const TexturePlaces& places)
{
    constexpr size_t n = Response::kKnots;
    std::vector<double> slopes;
    for (const float slope : known.slope) slopes.push_back(static_cast<double>(slope) - 1.0);
    CameraColumns columns = emptyColumns(places.texture.size(), std::move(slopes));
    columns.slope.assign(columns.bend.size(), 0.0f);
    columns.slopeKnown.assign(places.texture.size(), 0.0f);
    for (size_t i = 0; i < places.texture.size(); ++i) {
        const std::span<float> slope(&columns.slope[i * n], n);
        addSlopes(known, places.texture[i], {&columns.bend[i * n], n}, slope);
        for (size_t k = 0; k < n; ++k) columns.slopeKnown[i] += known.slope[k] * slope[k];
    }
    takeMeansOut(columns);
    for (size_t k = 0; k < n; ++k) columns.expected[k] = kUsualSlopes[k] - 1.0;
    columns.precision = precisionOfSlopes();
    return columns;
}

CameraColumns evenSlope(const CameraColumns& slopes)
{
    // Numerics.
    constexpr double kHeld = 1e6; // precision of what is not sought

    const auto sumOf = [](std::span<const float> all) {
        return std::accumulate(all.begin(), all.end(), 0.0f);
    };
    CameraColumns even{.known = {0.0}, .expected = {0.0}, .slopeKnown = slopes.slopeKnown};
    for (size_t i = 0; i < slopes.slopeKnown.size(); ++i) {
        even.bend.push_back(sumOf(slopes.bendAt(i)));
        even.slope.push_back(sumOf(slopes.slopeAt(i)));
    }
    even.precision = {kHeld};
    return even;
}

double flattenedBy(double open)
{
    return -kOpenFlattens * open;
}

Response responseOf(std::span<const double> coefficients, double share)
{
    Response response;
    for (size_t k = 0; k < Response::kKnots; ++k)
        response.slope[k] = static_cast<float>(
            std::clamp(1.0 + share * coefficients[k], kFlattestSlope, 1.0 / kFlattestSlope));
    return response;
}

bool isFlattening(std::span<const double> coefficients)
{
    constexpr size_t bright = Response::kKnots - 2; // of white itself hardly a place tells
    return coefficients[bright] > kUsualSlopes[bright] - 1.0;
}

SlopeCovariance doubtOfResponse(const LightEstimate& fit, double likely, double share)
{
    const double other = likely * (1.0 - share) * (1.0 - share) + (1.0 - likely) * share * share;
    SlopeCovariance doubt{};
    for (size_t i = 0; i < Response::kKnots; ++i)
        for (size_t k = 0; k < Response::kKnots; ++k)
            doubt[i * Response::kKnots + k] =
                static_cast<float>(likely * fit.cameraCovariance[i * fit.camera.size() + k] +
                                   other * fit.camera[i] * fit.camera[k]);
    return doubt;
}

Gain toneLatticeOver(std::span<const glm::vec3> position)
{
    return latticeOver(position, kToneSpacing, kMostToneKnots);
}

CameraColumns columnsOf(const LocalTone& known, const Gain& around, const TexturePlaces& places)
{
    CameraColumns columns = emptyColumns(places.position.size(), {1.0 / known.exponent - 1.0});
    for (size_t i = 0; i < places.position.size(); ++i)
        columns.bend[i] = logAt(around, places.position[i]).g;
    takeMeansOut(columns);
    columns.precision = {1.0 / (kToneSpread * kToneSpread)};
    return columns;
}

LocalTone localToneOf(const Gain& around, double coefficient)
{
    if (coefficient <= 0.0) return {};
    const double least = std::max(1.0 / (1.0 + coefficient), kFlattestSlope);
    LocalTone tone{.exponent = static_cast<float>(least), .gain = around};
    for (glm::vec3& log : tone.gain.log) log *= static_cast<float>(1.0 - 1.0 / least);
    return tone;
}

CameraColumns together(const CameraColumns& first, const CameraColumns& second)
{
    const size_t n = first.count();
    const size_t m = second.count();
    const size_t places = std::max(first.bend.size() / std::max<size_t>(n, 1),
                                   second.bend.size() / std::max<size_t>(m, 1));
    CameraColumns both{
        .slopeKnown = first.slopeKnown, .slope = first.slope, .worth = first.worth * second.worth};
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const CameraColumns* part : {&first, &second}) {
        append(both.known, part->known);
        append(both.expected, part->expected);
    }
    for (size_t i = 0; i < places; ++i) {
        append(both.bend, first.bendAt(i));
        append(both.bend, second.bendAt(i));
    }
    both.precision.assign((n + m) * (n + m), 0.0);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) both.precision[i * (n + m) + j] = first.precision[i * n + j];
    for (size_t i = 0; i < m; ++i)
        for (size_t j = 0; j < m; ++j)
            both.precision[(n + i) * (n + m) + n + j] = second.precision[i * m + j];
    return both;
}

Gain evenGainOver(std::span<const glm::vec3> position)
{
    constexpr int kFewest = 4; // along some side: a cupboard has no drift
    Gain gain = latticeOver(position, kKnotSpacing, kMostKnots);
    if (gain.isOne() || *std::max_element(gain.count.begin(), gain.count.end()) < kFewest)
        return {};
    return gain;
}

Gain coarseGainOver(std::span<const glm::vec3> position)
{
    return latticeOver(position, 2.0f * kKnotSpacing, kMostKnots);
}

std::vector<Gain> evenGainsOver(std::span<const std::vector<glm::vec3>> positions)
{
    std::vector<Gain> gains;
    for (const auto& ofRoom : positions) gains.push_back(evenGainOver(ofRoom));
    const auto isOne = [](const Gain& gain) { return gain.isOne(); };
    if (std::all_of(gains.begin(), gains.end(), isOne)) return {};
    for (size_t r = 0; r < gains.size(); ++r)
        if (gains[r].isOne()) gains[r] = latticeOver(positions[r], kKnotSpacing, 1);
    return gains;
}

CameraColumns columnsOf(const Gain& known, const TexturePlaces& places)
{
    std::vector<double> knots;
    for (const glm::vec3 log : known.log) knots.push_back(logLuminance(log));
    CameraColumns columns = emptyColumns(places.texture.size(), std::move(knots));
    for (size_t i = 0; i < places.position.size(); ++i) {
        const GainWeights weights = weightsAt(known, places.position[i]);
        for (size_t k = 0; k < weights.knot.size(); ++k)
            columns.bend[i * known.log.size() + weights.knot[k]] -= weights.part[k];
    }
    takeMeansOut(columns);
    columns.worth = kGainWorth;
    columns.precision = precisionOf(known, kGainSpread, kGainStep);
    return columns;
}

double likelihoodByEvidence(double drift)
{
    return 1.0 / (1.0 + std::exp(-drift - kHardlyEverNats));
}

double worthOfGain(double likely)
{
    return std::pow(kGainWorth, 2.0 * likely);
}

Gain gainOf(Gain lattice, std::span<const double> coefficients)
{
    for (size_t k = 0; k < lattice.log.size(); ++k)
        lattice.log[k] +=
            glm::vec3(static_cast<float>(coefficients[k] - logLuminance(lattice.log[k])));
    return lattice;
}

} // namespace relamp
