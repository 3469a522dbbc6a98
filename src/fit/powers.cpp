#include "fit/powers.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/squares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

namespace relamp
{
namespace
{

constexpr double kBrightestPaper = 0.9;   // albedo
constexpr double kLeastIrradiance = 1e-3; // what no measured place falls below
constexpr double kSmallest = -4.0;        // log radiance
constexpr double kLargest = 12.0;
constexpr double kFarFromWhite = 1.0; // log radiance; beyond, the prior hardly pulls any more
constexpr double kBehindHoles = .3;   // of the median radiance: what scanners miss lies in shade
constexpr double kHolesWeight = 2.0;  // of that prior, times that of a lamp
constexpr double kUsualAlbedo = 0.35; // of a room, mean of logarithms
constexpr double kLevelWeight = 4e-4; // of that, in pairs' squared residuals a pair
constexpr double kEffectivePairs = 150.0; // that all pairs are worth, see calibrate
constexpr double kNever = 1e6; // squared; the channels of a lamp are always pulled together

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

using Squares = Eigen::Map<RowMajor>; // lower triangles count

double medianOf(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// What a fit is of: a channel, or luminance where it is < 0; by what is burnt out, too, where that
/// bounds it.
struct Fitted
{
    int channel = -1;
    bool isBounded = false;
    std::span<const double> white{}; // log radiance of each lamp without evidence of its colour;
                                     // empty: the texture's
};

/// A residual with the Cauchy loss already in it: sign(r) sqrt(b log(1 + r^2 / b)), b = scale^2.
struct Robust
{
    double value;
    double slope; // d value / d r

    Robust(double r, double b)
    {
        const double size = std::sqrt(b * std::log(1.0 + r * r / b));
        value = std::copysign(size, r);
        slope = size > 1e-9 ? std::abs(r) / ((1.0 + r * r / b) * size) : 1.0;
    }
};

/// One channel of the data, and all residuals of its fit: of pairs, of what is burnt out, of lamps
/// that look alike, and of the prior. There are many more of them than unknowns, so their squares
/// are summed once a point, and Ceres gets the few residuals that have the same sums.
class Channel : public ceres::EvaluationCallback
{
public:
    Channel(const FitData& data, std::span<const MaterialPair> pairs, const PowersOptions& options,
            const Fitted& what);

    void setScale(double scale);
    void PrepareForEvaluation(bool, bool) override;

    [[nodiscard]] double* unknowns() { return log_.data(); }
    [[nodiscard]] size_t count() const { return log_.size(); }
    [[nodiscard]] double prior() const { return prior_; }
    /// Of a pair: log (L_p / L_q) - log (E_p / E_q).
    [[nodiscard]] double residual(MaterialPair pair) const
    {
        return logRadiance_[pair.p] - logRadiance_[pair.q] - logIrradiance_[pair.p] +
               logIrradiance_[pair.q];
    }
    /// d log E / d unknown at every place: the share of the irradiance that comes from it.
    [[nodiscard]] const PlaceTable& shares() const { return shares_; }
    /// As few residuals, one more than unknowns, as have the squares of all; and their Jacobian.
    [[nodiscard]] const Eigen::VectorXd& residuals() const { return residuals_; }
    [[nodiscard]] const RowMajor& jacobian() const { return jacobian_; }

private:
    [[nodiscard]] double pick(glm::vec3 rgb) const
    {
        return static_cast<double>(c_ < 0 ? luminance(rgb) : rgb[c_]);
    }
    [[nodiscard]] double firstGuess(size_t lamp) const;
    void findShares(size_t place, std::span<const float> value);
    [[nodiscard]] double lack(size_t place) const;
    double weighResiduals();
    void addAlike(Squares& squares) const;
    void addPrior(Squares& squares) const;
    void addLevel(Squares& squares) const;
    void condense(const Squares& squares);

    const FitData& data_;
    std::span<const MaterialPair> pairs_;
    const PowersOptions& options_;
    int c_; // < 0: luminance
    double pairsAPlace_;
    double prior_;
    double farFromPrior_;         // squared
    double b_ = 0.0;              // scale^2
    std::vector<double> wanted_;  // of lamps, then of ambient: where they are without evidence
    std::vector<double> log_;     // likewise: the unknowns
    std::vector<double> knownAt_; // unknowns that all below belongs to
    std::vector<double> logRadiance_;
    std::vector<double> gathered_;
    std::vector<double> logIrradiance_;
    PlaceTable shares_;                 // and a row of zeros
    std::vector<PairResidual> weighed_; // of pairs; then of burnt-out places beside that row
    Eigen::VectorXd residuals_;
    RowMajor jacobian_;
};

Channel::Channel(const FitData& data, std::span<const MaterialPair> pairs,
                 const PowersOptions& options, const Fitted& what)
    : data_(data), pairs_(pairs), options_(options), c_(what.channel),
      pairsAPlace_(static_cast<double>(pairs.size()) /
                   static_cast<double>(std::max<size_t>(data.places(), 1))),
      prior_(std::sqrt(options.priorWeight * pairsAPlace_)),
      farFromPrior_(what.white.empty() ? kFarFromWhite * kFarFromWhite : kNever),
      wanted_(what.white.begin(), what.white.end()), logIrradiance_(data.radiance.size()),
      shares_(data.radiance.size() + 1, data.lamps + 1)
{
    for (size_t i = 0; i < data.radiance.size(); ++i) {
        logRadiance_.push_back(std::log(std::max(pick(data.radiance[i]), 1e-4)));
        gathered_.push_back(pick(data.gathered[i]));
    }
    wanted_.resize(data.lamps, 0.0);
    const auto end = logRadiance_.begin() + static_cast<ptrdiff_t>(data.places());
    wanted_.push_back(medianOf({logRadiance_.begin(), end}) + std::log(kBehindHoles));
    log_ = wanted_;
    if (options.start.empty() && !pairs.empty())
        for (size_t f = 0; f < data.lamps; ++f) log_[f] = std::max(log_[f], firstGuess(f));
    for (size_t f = 0; f < options.start.size(); ++f)
        log_[f] = std::log(std::max(pick(options.start[f]), 1e-2));
    for (const MaterialPair pair : pairs) weighed_.push_back({pair, 0.0f, 0.0f});
    const auto zeros = static_cast<uint32_t>(data.radiance.size());
    if (what.isBounded && !pairs.empty())
        for (auto i = static_cast<uint32_t>(data.places()); i < zeros; ++i)
            weighed_.push_back({{i, zeros}, 0.0f, 0.0f});
}

/// Log radiance from which a lamp can be seen to be too bright or too dark, where all together
/// bring what is gathered: a small one at white brings so little that no step up or down would
/// show.
double Channel::firstGuess(size_t lamp) const
{
    double gathered = 0.0;
    double direct = 0.0;
    for (size_t i = 0; i < data_.places(); ++i) {
        gathered += gathered_[i];
        direct += static_cast<double>(data_.direct[i * data_.lamps + lamp]);
    }
    if (direct <= 0.0) return 0.0;
    return std::log(std::max(gathered / direct / static_cast<double>(data_.lamps), 1.0));
}

void Channel::setScale(double scale)
{
    b_ = scale * scale;
    knownAt_.clear();
}

/// Ceres asks for a point again, with and without a Jacobian.
void Channel::PrepareForEvaluation(bool, bool)
{
    if (knownAt_ == log_) return;
    knownAt_ = log_;
    std::vector<float> value;
    for (const double log : log_) value.push_back(static_cast<float>(std::exp(log)));
    forEachChunk(logRadiance_.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) findShares(i, value);
    });
    const double sum = weighResiduals();
    std::vector<double> ofWeighed = squaresOf(shares_, weighed_);
    const auto size = static_cast<Eigen::Index>(count() + 1);
    Eigen::Map<RowMajor> squares(ofWeighed.data(), size, size);
    squares(size - 1, size - 1) = sum; // in double precision
    addAlike(squares);
    addPrior(squares);
    addLevel(squares);
    condense(squares);
}

void Channel::findShares(size_t i, std::span<const float> value)
{
    float* share = shares_.row(i);
    const float* direct = data_.direct.data() + i * data_.lamps;
    for (size_t f = 0; f < data_.lamps; ++f) share[f] = value[f] * direct[f];
    share[data_.lamps] = value[data_.lamps] * data_.missed[i];
    float sums[kLanes] = {}; // rows are padded by zeros
    for (size_t f = 0; f < shares_.stride(); f += kLanes) RELAMP_KEEP_LOOP
    for (size_t lane = 0; lane < kLanes; ++lane) sums[lane] += share[f + lane];
    double sum = gathered_[i] + kLeastIrradiance;
    for (const float part : sums) sum += static_cast<double>(part);
    logIrradiance_[i] = std::log(sum);
    const auto perSum = static_cast<float>(1.0 / sum);
    for (size_t f = 0; f < value.size(); ++f) share[f] *= perSum;
}

/// How much too dark a burnt-out place is even as the brightest paper; 0 where it is not.
double Channel::lack(size_t place) const
{
    const double least = logRadiance_[place] + std::log(std::numbers::pi / kBrightestPaper);
    return std::max(least - logIrradiance_[place], 0.0);
}

/// Pairs; and what is burnt out and no lamp, which must get the light for it. Robust, for pairs may
/// be of two materials, and a highlight on polish gets less. Gives the sum of all squares.
double Channel::weighResiduals()
{
    constexpr size_t kChunk = 1024;
    const double weight = std::sqrt(pairsAPlace_);
    std::vector<double> sums((weighed_.size() + kChunk - 1) / kChunk, 0.0);
    forEachChunk(weighed_.size(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            PairResidual& weighed = weighed_[i];
            const bool isPair = i < pairs_.size();
            const double r = isPair ? residual(weighed.pair) : lack(weighed.pair.p);
            const Robust robust(r, b_);
            const double scale = isPair ? 1.0 : r > 0.0 ? weight : 0.0;
            weighed.slope = static_cast<float>(scale * robust.slope);
            weighed.value = static_cast<float>(scale * robust.value);
            sums[begin / kChunk] += scale * scale * robust.value * robust.value;
        }
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Pulls lamps that look alike towards one brightness.
void Channel::addAlike(Squares& squares) const
{
    const double weight = options_.alikeWeight * static_cast<double>(pairs_.size());
    const Eigen::Index last = squares.rows() - 1;
    for (const auto& [a, b, ratio] : options_.alike) {
        const double step = log_[a] - log_[b] - std::log(ratio);
        squares(a, a) += weight;
        squares(b, b) += weight;
        squares(std::max(a, b), std::min(a, b)) -= weight;
        squares(last, a) += weight * step;
        squares(last, b) -= weight * step;
        squares(last, last) += weight * step * step;
    }
}

/// Pulls every unknown a little towards where it is without evidence. Towards white less and less:
/// a piece is either a wall, about white, or a lamp of whatever brightness, and a pull that grew
/// with the distance would hold two dozen small spots back.
void Channel::addPrior(Squares& squares) const
{
    const Eigen::Index last = squares.rows() - 1;
    for (Eigen::Index f = 0; f < last; ++f) {
        const auto u = static_cast<size_t>(f);
        const double weight = prior_ * prior_ * (u < data_.lamps ? 1.0 : kHolesWeight);
        const Robust step(log_[u] - wanted_[u], farFromPrior_);
        squares(f, f) += weight * step.slope * step.slope;
        squares(last, f) += weight * step.slope * step.value;
        squares(last, last) += weight * step.value * step.value;
    }
}

/// Pulls the albedo of all places together a little towards a room's: where lamps outshine all that
/// is gathered, pairs do not tell how much, and it would run away.
void Channel::addLevel(Squares& squares) const
{
    if (pairs_.empty()) return;
    constexpr size_t kChunk = 512;
    const size_t stride = shares_.stride();
    std::vector<float> sums((data_.places() + kChunk - 1) / kChunk * stride, 0.0f);
    forEachChunk(data_.places(), kChunk, [&](size_t begin, size_t end) {
        float* sum = sums.data() + begin / kChunk * stride;
        for (size_t i = begin; i < end; ++i) {
            const float* share = shares_.row(i);
            for (size_t f = 0; f < stride; ++f) sum[f] += share[f];
        }
    });
    const auto places = static_cast<double>(data_.places());
    Eigen::VectorXd row = Eigen::VectorXd::Zero(squares.rows());
    for (size_t at = 0; at < sums.size(); at += stride)
        for (size_t f = 0; f < count(); ++f)
            row[static_cast<Eigen::Index>(f)] -= static_cast<double>(sums[at + f]) / places;
    double& level = row[squares.rows() - 1];
    for (size_t i = 0; i < data_.places(); ++i) level += logRadiance_[i] - logIrradiance_[i];
    level = level / places + std::log(std::numbers::pi / kUsualAlbedo);
    squares += kLevelWeight * static_cast<double>(pairs_.size()) * row * row.transpose();
}

/// Of squares P^T L D L^T P, by their lower triangle, the rows of D^1/2 L^T P have just these.
void Channel::condense(const Squares& squares)
{
    const Eigen::LDLT<Eigen::MatrixXd> factors(squares);
    RowMajor rows = RowMajor::Identity(squares.rows(), squares.cols());
    rows = factors.transpositionsP() * rows;
    rows = factors.matrixU() * rows;
    rows = factors.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal() * rows;
    residuals_ = rows.rightCols<1>();
    jacobian_ = rows.leftCols(rows.cols() - 1);
}

/// A channel's residuals, as Ceres wants them.
class ChannelCost : public ceres::CostFunction
{
public:
    explicit ChannelCost(const Channel& channel) : channel_(channel)
    {
        set_num_residuals(static_cast<int>(channel.count()) + 1);
        mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(channel.count()));
    }

    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override
    {
        std::copy_n(channel_.residuals().data(), channel_.residuals().size(), residuals);
        if (jacobians != nullptr && jacobians[0] != nullptr)
            std::copy_n(channel_.jacobian().data(), channel_.jacobian().size(), jacobians[0]);
        return true;
    }

private:
    const Channel& channel_;
};

struct ChannelFit
{
    std::vector<double> log;
    std::vector<double> error;
    std::vector<double> told;
    double residual = 0.0;
    double loss = 0.0;
};

/// Standard errors from the inverse of the information that unbroken pairs give, were each of them
/// wrong by itself.
std::vector<double> errorsOf(const Channel& channel, std::span<const MaterialPair> pairs,
                             double scale, double prior)
{
    const auto n = static_cast<Eigen::Index>(channel.count());
    std::vector<PairResidual> weighed;
    for (const MaterialPair pair : pairs) {
        const double r = channel.residual(pair) / scale;
        weighed.push_back({pair, static_cast<float>(1.0 / std::sqrt(1.0 + r * r)), 0.0f});
    }
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    std::vector<double> squares = squaresOf(channel.shares(), weighed);
    const Eigen::MatrixXd information =
        prior * prior * identity + Squares(squares.data(), n + 1, n + 1).topLeftCorner(n, n);
    const Eigen::MatrixXd covariance = information.llt().solve(identity);
    std::vector<double> errors(channel.count());
    for (Eigen::Index f = 0; f < n; ++f)
        errors[static_cast<size_t>(f)] = scale * std::sqrt(covariance(f, f));
    return errors;
}

/// What is wrong with the light at a place is wrong at all places near it, so that tens of
/// thousands of pairs are worth a hundred or two that are wrong by themselves. In 14 rooms with
/// ground truth two thirds of 62 lamps lie within one standard error so, and nineteen in twenty
/// within two.
void calibrate(size_t pairs, std::span<double> errors)
{
    const double worth = std::max(static_cast<double>(pairs) / kEffectivePairs, 1.0);
    for (double& error : errors) error *= std::sqrt(worth);
}

/// Finds the unknowns, from a wide loss to a narrow one.
void solve(Channel& channel, const PowersOptions& options)
{
    for (double scale = options.firstScale;; scale = std::max(0.5 * scale, options.lastScale)) {
        channel.setScale(scale);
        ceres::Problem::Options ownership;
        ownership.evaluation_callback = &channel;
        ceres::Problem problem(ownership);
        problem.AddParameterBlock(channel.unknowns(), static_cast<int>(channel.count()));
        for (int f = 0; f < static_cast<int>(channel.count()); ++f) {
            problem.SetParameterLowerBound(channel.unknowns(), f, kSmallest);
            problem.SetParameterUpperBound(channel.unknowns(), f, kLargest);
        }
        problem.AddResidualBlock(new ChannelCost(channel), nullptr, channel.unknowns());
        ceres::Solver::Options solver;
        solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
        solver.max_num_iterations = 50;
        solver.function_tolerance = options.tolerance;
        solver.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(solver, &problem, &summary);
        if (scale <= options.lastScale) break;
    }
    channel.PrepareForEvaluation(false, true);
}

ChannelFit fitChannel(const FitData& data, std::span<const MaterialPair> pairs,
                      const PowersOptions& options, const Fitted& what)
{
    Channel channel(data, pairs, options, what);
    solve(channel, options);
    ChannelFit fit;
    fit.log.assign(channel.unknowns(), channel.unknowns() + channel.count());
    const double known = std::max(channel.prior(), 1e-3);
    fit.error = errorsOf(channel, pairs, options.lastScale, known);
    for (const double error : fit.error) {
        const double left = error * known / options.lastScale; // of the prior's own error
        fit.told.push_back(1.0 - left * left);
    }
    calibrate(pairs.size(), fit.error);
    std::vector<double> sizes;
    for (const MaterialPair& pair : pairs) {
        sizes.push_back(std::abs(channel.residual(pair)));
        const double size = sizes.back() / options.lastScale;
        fit.loss += std::log1p(size * size) / static_cast<double>(pairs.size());
    }
    fit.residual = medianOf(std::move(sizes));
    return fit;
}

/// The three channels. Without evidence a lamp is as bright as it is in luminance, and white: a
/// channel that the pairs hardly tell of would else come out at the texture's white, beside others
/// a hundred times as bright.
///
/// Burnt-out walls tell how bright the lamps must be, and pairs alone of what colour: a wall of
/// warm light burns out in red first, and would make lamps redder than they are.
std::array<ChannelFit, 3> fitColors(const FitData& data, std::span<const MaterialPair> pairs,
                                    const PowersOptions& options)
{
    const bool isBounded = data.burntOut > 0;
    std::array<ChannelFit, 2> luminance;
    forEach(isBounded ? 2 : 1, [&](size_t i) {
        luminance[i] = fitChannel(data, pairs, options, {.isBounded = i == 1});
    });
    const std::span<const double> white(luminance[0].log.data(), data.lamps);
    std::array<ChannelFit, 3> fits;
    forEach(3, [&](size_t c) {
        fits[c] =
            fitChannel(data, pairs, options, {.channel = static_cast<int>(c), .white = white});
        if (!isBounded) return;
        for (size_t f = 0; f < fits[c].log.size(); ++f)
            fits[c].log[f] += luminance[1].log[f] - luminance[0].log[f];
    });
    return fits;
}

} // namespace

Powers fitPowers(const FitData& data, std::span<const MaterialPair> pairs,
                 const PowersOptions& options)
{
    std::array<ChannelFit, 3> fits;
    if (options.oneChannel)
        fits.fill(fitChannel(data, pairs, options, {.isBounded = true}));
    else
        fits = fitColors(data, pairs, options);
    Powers powers;
    powers.radiance.resize(data.lamps);
    powers.logError.resize(data.lamps);
    powers.told.assign(data.lamps, 1.0f);
    for (int c = 0; c < 3; ++c) {
        const ChannelFit& fit = fits[static_cast<size_t>(c)];
        for (size_t f = 0; f < data.lamps; ++f) {
            powers.radiance[f][c] = static_cast<float>(std::exp(fit.log[f]));
            powers.logError[f][c] = static_cast<float>(fit.error[f]);
            powers.told[f] = std::min(powers.told[f], static_cast<float>(fit.told[f]));
        }
        powers.ambient[c] = static_cast<float>(std::exp(fit.log[data.lamps]));
        powers.loss += static_cast<float>(fit.loss) / 3.0f;
        powers.residual += static_cast<float>(fit.residual) / 3.0f;
    }
    return powers;
}

} // namespace relamp
