#include "fit/white_balance.h"

#include "base/radiometry.shared.h"
#include "fit/camera_columns.h"
#include "fit/light_fit_search.h"
#include "scan/gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

namespace relamp
{
namespace
{

constexpr double kTintStep = 0.04;       // log: likewise, from knot to knot
constexpr double kLeastTintNoise = 0.01; // log: what a byte tells of a colour

// Numerics.
constexpr int kRounds = 5; // of reweighted least squares

/// A pair's knots: those of one place, and those of the other with the sign turned.
struct Row
{
    std::array<Eigen::Index, 16> knot;
    std::array<double, 16> part;
};

std::vector<Row> rowsOf(const Gain& gain, std::span<const glm::vec3> position,
                        std::span<const MaterialPair> pairs)
{
    std::vector<Row> rows(pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
        const GainWeights p = weightsAt(gain, position[pairs[i].p]);
        const GainWeights q = weightsAt(gain, position[pairs[i].q]);
        for (size_t k = 0; k < 8; ++k) {
            rows[i].knot[k] = p.knot[k];
            rows[i].part[k] = static_cast<double>(p.part[k]);
            rows[i].knot[8 + k] = q.knot[k];
            rows[i].part[8 + k] = -static_cast<double>(q.part[k]);
        }
    }
    return rows;
}

/// Cauchy's, of a scale of its own.
double costOf(std::span<const double> differences, double noise)
{
    double cost = 0.0;
    for (const double d : differences) cost += std::log(noise + d * d / noise);
    return cost;
}

struct TintFit
{
    Eigen::VectorXd knots;
    double evidence; // nats for a drift, with its Occam factor
};

/// Knots that explain the differences of pairs best, by Cauchy's loss and the prior. Each pair is
/// `worth` an independent one, but for those from `told` on, which a person named: one each.
TintFit fitOf(const std::vector<Row>& rows, const std::vector<double>& difference,
              const Eigen::MatrixXd& prior, double worth, size_t told)
{
    const auto noiseOf = [&](const std::vector<double>& left) {
        std::vector<double> sizes(told);
        std::transform(left.begin(), left.begin() + static_cast<ptrdiff_t>(told), sizes.begin(),
                       [](double d) { return std::abs(d); });
        return std::max(medianOfAll(std::move(sizes)), kLeastTintNoise);
    };
    Eigen::VectorXd knots = Eigen::VectorXd::Zero(prior.rows());
    Eigen::MatrixXd matrix;
    std::vector<double> left = difference;
    for (int round = 0; round < kRounds; ++round) {
        const double noise = noiseOf(left);
        matrix = prior;
        Eigen::VectorXd slope = Eigen::VectorXd::Zero(prior.rows());
        for (size_t i = 0; i < rows.size(); ++i) {
            const Row& row = rows[i];
            const double weight = i < told ? 2.0 * worth / (noise * noise + left[i] * left[i])
                                           : 1.0 / (kFirstNoise * kFirstNoise);
            for (size_t a = 0; a < row.knot.size(); ++a) {
                slope[row.knot[a]] += weight * row.part[a] * difference[i];
                for (size_t b = 0; b < row.knot.size(); ++b)
                    matrix(row.knot[a], row.knot[b]) += weight * row.part[a] * row.part[b];
            }
        }
        knots = matrix.llt().solve(slope);
        for (size_t i = 0; i < rows.size(); ++i) {
            left[i] = difference[i];
            for (size_t a = 0; a < rows[i].knot.size(); ++a)
                left[i] -= rows[i].part[a] * knots[rows[i].knot[a]];
        }
    }
    const double gained = costOf(std::span(difference).first(told), noiseOf(difference)) -
                          costOf(std::span(left).first(told), noiseOf(left));
    const double evidence = worth * gained - 0.5 * knots.dot(prior * knots) -
                            0.5 * (logDeterminant(matrix) - logDeterminant(prior));
    return {std::move(knots), evidence};
}

/// Of red or blue over green, between the places of pairs: logarithms.
std::vector<double> differencesOf(std::span<const glm::vec3> albedo, int channel,
                                  std::span<const MaterialPair> pairs,
                                  std::span<const MaterialPair> told)
{
    const auto overGreen = [&](uint32_t place) {
        return static_cast<double>(logOfLight(albedo[place][channel]) -
                                   logOfLight(albedo[place].g));
    };
    std::vector<double> differences;
    for (const auto some : {pairs, told})
        for (const MaterialPair pair : some)
            differences.push_back(overGreen(pair.p) - overGreen(pair.q));
    return differences;
}

/// Of a channel, without a change of brightness.
void addTint(Gain& gain, int channel, const Eigen::VectorXd& knots)
{
    glm::vec3 tint(0.0f);
    tint[channel] = 1.0f;
    tint -= glm::vec3(luminance(tint));
    for (size_t k = 0; k < gain.log.size(); ++k)
        gain.log[k] += tint * static_cast<float>(knots[static_cast<Eigen::Index>(k)]);
}

} // namespace

Gain withWhiteBalance(Gain gain, std::span<const glm::vec3> position,
                      std::span<const glm::vec3> albedo, std::span<const MaterialPair> pairs,
                      std::span<const MaterialPair> told, const DriftBelief& belief)
{
    std::vector<Row> rows = rowsOf(gain, position, pairs);
    const std::vector<Row> rowsOfTold = rowsOf(gain, position, told);
    rows.insert(rows.end(), rowsOfTold.begin(), rowsOfTold.end());
    const std::vector<double> precision = precisionOf(gain, kTintSpread, kTintStep);
    const auto knotCount = static_cast<Eigen::Index>(gain.log.size());
    const Eigen::MatrixXd prior =
        Eigen::Map<const Eigen::MatrixXd>(precision.data(), knotCount, knotCount);

    const std::vector<double> red = differencesOf(albedo, 0, pairs, told);
    const std::vector<double> blue = differencesOf(albedo, 2, pairs, told);
    const double perPair =
        belief.independent / static_cast<double>(std::max<size_t>(pairs.size(), 1));
    const auto fit = [&](const std::vector<double>& differences, double worth) {
        return fitOf(rows, differences, prior, worth * perPair, pairs.size());
    };
    const double evidence = fit(red, kGainWorth).evidence + fit(blue, kGainWorth).evidence;
    const double likely = 1.0 - (1.0 - belief.exposure) * (1.0 - likelihoodByEvidence(evidence));
    // What is wrong with the light is hardly coloured, so every place tells of its own.
    const double places = static_cast<double>(position.size()) / belief.independent;
    const double worth = std::pow(std::max(places, 1.0), likely);
    addTint(gain, 0, fit(red, worth).knots);
    addTint(gain, 2, fit(blue, worth).knots);
    return gain;
}

} // namespace relamp
