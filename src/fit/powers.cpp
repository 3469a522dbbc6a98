#include "fit/powers.h"

#include "base/parallel.h"
#include "lights/expand.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <ceres/ceres.h>

namespace relamp
{
namespace
{

constexpr double kPi = 3.14159265358979;
constexpr double kBrightestPaper = 0.9;   // albedo
constexpr double kLeastIrradiance = 1e-3; // what no measured place falls below
constexpr double kSmallest = -4.0;        // log radiance
constexpr double kLargest = 8.5;

double medianOf(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// One channel of the data, and what every evaluation of the fit shares: the irradiance of all
/// places.
class Channel : public ceres::EvaluationCallback
{
public:
    /// `white`: log radiance of each lamp without evidence of its colour.
    Channel(const FitData& data, int c, std::span<const double> white)
        : data_(data), c_(c), unknowns_(data.lamps + 1), wanted_(white.begin(), white.end())
    {
        wanted_.resize(data.lamps, 0.0);
        for (size_t i = 0; i < data.radiance.size(); ++i) {
            logRadiance_.push_back(std::log(std::max(pick(data.radiance[i]), 1e-4)));
            gathered_.push_back(pick(data.gathered[i]));
        }
        const auto end = logRadiance_.begin() + static_cast<ptrdiff_t>(data_.places());
        wanted_.push_back(medianOf({logRadiance_.begin(), end}));
        log_ = wanted_;
        logIrradiance_.resize(data.radiance.size());
        share_.resize(data.radiance.size() * unknowns_);
    }

    void PrepareForEvaluation(bool, bool) override
    {
        std::vector<double> value(unknowns_);
        for (size_t f = 0; f < unknowns_; ++f) value[f] = std::exp(log_[f]);
        forEachChunk(logRadiance_.size(), 512, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) evaluate(i, value);
        });
    }

    [[nodiscard]] double pick(glm::vec3 rgb) const
    {
        return static_cast<double>(c_ < 0 ? luminance(rgb) : rgb[c_]);
    }
    [[nodiscard]] double* unknowns() { return log_.data(); }
    [[nodiscard]] size_t count() const { return unknowns_; }
    /// Where the unknowns are without evidence; what lies behind holes is as bright as the room.
    [[nodiscard]] const std::vector<double>& wanted() const { return wanted_; }
    [[nodiscard]] double residual(MaterialPair pair) const
    {
        return logRadiance_[pair.p] - logRadiance_[pair.q] - logIrradiance_[pair.p] +
               logIrradiance_[pair.q];
    }
    /// How much too dark a burnt-out place is even as the brightest paper; 0 where it is not.
    [[nodiscard]] double lack(size_t burntOut) const
    {
        const size_t place = data_.places() + burntOut;
        const double least = logRadiance_[place] + std::log(kPi / kBrightestPaper);
        return std::max(least - logIrradiance_[place], 0.0);
    }
    /// d log E / d unknown at a place: the share of the irradiance that comes from it.
    [[nodiscard]] const double* shares(uint32_t place) const { return &share_[place * unknowns_]; }
    [[nodiscard]] const double* sharesBurntOut(size_t place) const
    {
        return &share_[(data_.places() + place) * unknowns_];
    }

private:
    void evaluate(size_t i, const std::vector<double>& value)
    {
        double* share = &share_[i * unknowns_];
        double sum = gathered_[i] + kLeastIrradiance;
        for (size_t f = 0; f < data_.lamps; ++f)
            sum += share[f] = value[f] * static_cast<double>(data_.direct[i * data_.lamps + f]);
        sum += share[data_.lamps] = value[data_.lamps] * static_cast<double>(data_.missed[i]);
        logIrradiance_[i] = std::log(sum);
        for (size_t f = 0; f < unknowns_; ++f) share[f] /= sum;
    }

    const FitData& data_;
    int c_; // < 0: luminance
    size_t unknowns_;
    std::vector<double> wanted_; // of lamps, then of ambient
    std::vector<double> log_;    // likewise
    std::vector<double> logRadiance_;
    std::vector<double> gathered_;
    std::vector<double> logIrradiance_;
    std::vector<double> share_;
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

/// log (L_p / L_q) - log (E_p / E_q) of all pairs. One block of residuals, as there is one of
/// unknowns; a block a pair would take Ceres longer than the sums in it.
class PairsCost : public ceres::CostFunction
{
public:
    PairsCost(const Channel& channel, std::span<const MaterialPair> pairs, double scale)
        : channel_(channel), pairs_(pairs), b_(scale * scale)
    {
        set_num_residuals(static_cast<int>(pairs.size()));
        mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(channel.count()));
    }

    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override
    {
        double* jacobian = jacobians == nullptr ? nullptr : jacobians[0];
        forEachChunk(pairs_.size(), 2048, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) evaluate(i, residuals, jacobian);
        });
        return true;
    }

private:
    void evaluate(size_t i, double* residuals, double* jacobian) const
    {
        const Robust robust(channel_.residual(pairs_[i]), b_);
        residuals[i] = robust.value;
        if (jacobian == nullptr) return;
        const double* p = channel_.shares(pairs_[i].p);
        const double* q = channel_.shares(pairs_[i].q);
        double* row = jacobian + i * channel_.count();
        for (size_t f = 0; f < channel_.count(); ++f) row[f] = robust.slope * (q[f] - p[f]);
    }

    const Channel& channel_;
    std::span<const MaterialPair> pairs_;
    double b_;
};

/// What is burnt out and no lamp must get the light for it. Robust, for a highlight on polish gets
/// less.
class BurntOutCost : public ceres::CostFunction
{
public:
    BurntOutCost(const Channel& channel, size_t places, double scale, double weight)
        : channel_(channel), places_(places), b_(scale * scale), weight_(weight)
    {
        set_num_residuals(static_cast<int>(places));
        mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(channel.count()));
    }

    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override
    {
        double* jacobian = jacobians == nullptr ? nullptr : jacobians[0];
        for (size_t i = 0; i < places_; ++i) {
            const double lack = channel_.lack(i);
            const Robust robust(lack, b_);
            residuals[i] = weight_ * robust.value;
            if (jacobian == nullptr) continue;
            const double slope = lack > 0.0 ? weight_ * robust.slope : 0.0;
            const double* shares = channel_.sharesBurntOut(i);
            for (size_t f = 0; f < channel_.count(); ++f)
                jacobian[i * channel_.count() + f] = -slope * shares[f];
        }
        return true;
    }

private:
    const Channel& channel_;
    size_t places_;
    double b_;
    double weight_;
};

/// Pulls lamps that look alike towards one radiance.
class AlikeCost : public ceres::CostFunction
{
public:
    AlikeCost(const std::vector<std::pair<uint32_t, uint32_t>>& alike, size_t count, double weight)
        : alike_(alike), count_(count), weight_(weight)
    {
        set_num_residuals(static_cast<int>(alike.size()));
        mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(count));
    }

    bool Evaluate(double const* const* parameters, double* residuals,
                  double** jacobians) const override
    {
        const double* log = parameters[0];
        double* jacobian = jacobians == nullptr ? nullptr : jacobians[0];
        if (jacobian != nullptr) std::fill_n(jacobian, alike_.size() * count_, 0.0);
        for (size_t i = 0; i < alike_.size(); ++i) {
            const auto [a, b] = alike_[i];
            residuals[i] = weight_ * (log[a] - log[b]);
            if (jacobian == nullptr) continue;
            jacobian[i * count_ + a] = weight_;
            jacobian[i * count_ + b] = -weight_;
        }
        return true;
    }

private:
    const std::vector<std::pair<uint32_t, uint32_t>>& alike_;
    size_t count_;
    double weight_;
};

/// Pulls every unknown a little towards where it is without evidence.
class PriorCost : public ceres::CostFunction
{
public:
    PriorCost(std::vector<double> wanted, double weight)
        : wanted_(std::move(wanted)), count_(wanted_.size()), weight_(weight)
    {
        const size_t count = count_;
        set_num_residuals(static_cast<int>(count));
        mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(count));
    }

    bool Evaluate(double const* const* parameters, double* residuals,
                  double** jacobians) const override
    {
        for (size_t f = 0; f < count_; ++f)
            residuals[f] = weight_ * (parameters[0][f] - wanted_[f]);
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        std::fill_n(jacobians[0], count_ * count_, 0.0);
        for (size_t f = 0; f < count_; ++f) jacobians[0][f * count_ + f] = weight_;
        return true;
    }

private:
    std::vector<double> wanted_;
    size_t count_;
    double weight_;
};

struct ChannelFit
{
    std::vector<double> log;
    std::vector<double> error;
    std::vector<double> told;
    double residual = 0.0;
    double loss = 0.0;
};

/// Standard errors from the inverse of the information that unbroken pairs give.
std::vector<double> errorsOf(const Channel& channel, std::span<const MaterialPair> pairs,
                             double scale, double prior)
{
    const auto n = static_cast<Eigen::Index>(channel.count());
    Eigen::MatrixXd information = Eigen::MatrixXd::Identity(n, n) * prior * prior;
    for (const MaterialPair& pair : pairs) {
        const double r = channel.residual(pair);
        const double weight = 1.0 / (1.0 + r * r / (scale * scale));
        const Eigen::Map<const Eigen::VectorXd> p(channel.shares(pair.p), n);
        const Eigen::Map<const Eigen::VectorXd> q(channel.shares(pair.q), n);
        const Eigen::VectorXd step = q - p;
        information.selfadjointView<Eigen::Lower>().rankUpdate(step, weight);
    }
    const Eigen::MatrixXd covariance =
        information.selfadjointView<Eigen::Lower>().llt().solve(Eigen::MatrixXd::Identity(n, n));
    std::vector<double> errors(channel.count());
    for (Eigen::Index f = 0; f < n; ++f)
        errors[static_cast<size_t>(f)] = scale * std::sqrt(covariance(f, f));
    return errors;
}

/// What a fit is of: a channel, or luminance where it is < 0; by what is burnt out, too, where that
/// bounds it.
struct Fitted
{
    int channel = -1;
    bool isBounded = false;
    std::span<const double> white{}; // see Channel; empty: the texture's
};

ChannelFit fitChannel(const FitData& data, std::span<const MaterialPair> pairs,
                      const PowersOptions& options, const Fitted& what)
{
    Channel channel(data, what.channel, what.white);
    for (size_t f = 0; f < options.start.size(); ++f)
        channel.unknowns()[f] = std::log(std::max(channel.pick(options.start[f]), 1e-2));
    const double pairsAPlace =
        static_cast<double>(pairs.size()) / static_cast<double>(std::max<size_t>(data.places(), 1));
    const double prior = std::sqrt(options.priorWeight * pairsAPlace);
    for (double scale = options.firstScale;; scale = std::max(0.5 * scale, options.lastScale)) {
        ceres::Problem::Options ownership;
        ownership.evaluation_callback = &channel;
        ceres::Problem problem(ownership);
        problem.AddParameterBlock(channel.unknowns(), static_cast<int>(channel.count()));
        for (int f = 0; f < static_cast<int>(channel.count()); ++f) {
            problem.SetParameterLowerBound(channel.unknowns(), f, kSmallest);
            problem.SetParameterUpperBound(channel.unknowns(), f, kLargest);
        }
        if (!pairs.empty())
            problem.AddResidualBlock(new PairsCost(channel, pairs, scale), nullptr,
                                     channel.unknowns());
        if (what.isBounded && data.burntOut > 0 && !pairs.empty())
            problem.AddResidualBlock(
                new BurntOutCost(channel, data.burntOut, scale, std::sqrt(pairsAPlace)), nullptr,
                channel.unknowns());
        if (!options.alike.empty())
            problem.AddResidualBlock(
                new AlikeCost(options.alike, channel.count(),
                              std::sqrt(options.alikeWeight * static_cast<double>(pairs.size()))),
                nullptr, channel.unknowns());
        problem.AddResidualBlock(new PriorCost(channel.wanted(), prior), nullptr,
                                 channel.unknowns());
        ceres::Solver::Options solver;
        solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
        solver.max_num_iterations = 25;
        solver.function_tolerance = 1e-4;
        solver.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(solver, &problem, &summary);
        if (scale <= options.lastScale) break;
    }
    channel.PrepareForEvaluation(false, true);
    ChannelFit fit;
    fit.log.assign(channel.unknowns(), channel.unknowns() + channel.count());
    const double known = std::max(prior, 1e-3);
    fit.error = errorsOf(channel, pairs, options.lastScale, known);
    for (const double error : fit.error) {
        const double left = error * known / options.lastScale; // of the prior's own error
        fit.told.push_back(1.0 - left * left);
    }
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
