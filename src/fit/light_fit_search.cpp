#include "fit/light_fit_search.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/camera_columns.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

namespace relamp
{
namespace
{

constexpr double kWhiteNats = 0.1;     // weight of a burnt-out piece being about white
constexpr double kBareBulb = 7.0;      // log radiance: 1e5 cd/m^2 over white paper in 300 lux
constexpr double kOutsideSpread = 2.0; // log: how much less small holes may show than is expected
constexpr double kOutsideMore = 0.7;   // log: how much more; they are hardly brighter than a room
constexpr double kOpeningNats = 0.5;   // weight of an opening being as dark as small holes
constexpr double kAlikeSpread = 0.6;   // log: between lamps of one model
constexpr double kAlbedoSpread = 0.4;  // log: of that mean between rooms
constexpr double kDarkerPaper = 0.8;   // log: how much less that may be, and the light on it
constexpr double kWhiterPaper = 0.3;   // log: how much more

// Numerics.
constexpr double kConverged = 0.01;   // nats
constexpr int kMostSteps = 30;        // for time alone
constexpr double kStillToCome = 20.0; // times what a step gained, at most, by all that follow
constexpr double kLongestStep = 2.0;  // log

/// Second derivative of log(1 + x^2), as a share of its slope over x. Where it is negative a step
/// has little to go by: steps by the slope over x alone are safe, and creep.
double bentShare(double x)
{
    // Numerics.
    constexpr double kLeast = 0.05; // for less a step is as long as ever, and gains nothing

    return std::max((1.0 - x * x) / (1.0 + x * x), kLeast);
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

} // namespace

double logDeterminant(const Eigen::MatrixXd& matrix)
{
    return 2.0 * matrix.llt().matrixL().toDenseMatrix().diagonal().array().log().sum();
}

double medianOfAll(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<double> exponentials(std::span<const double> log)
{
    std::vector<double> values;
    for (const double l : log) values.push_back(std::exp(l));
    return values;
}

LightFitSearch::LightFitSearch(const LightFit& fit, std::span<const uint8_t> emits,
                               const EmissionPrior& prior, std::vector<double> start,
                               const CameraColumns& camera)
    : fit_(fit), model_(fit.model_), emits_(emits), prior_(prior), camera_(camera),
      unknownOf_(emits.size(), -1)
{
    for (const size_t f : fit.light_.order) {
        if (emits[f] == 0 &&
            (!prior.log.empty() || model_.area[f] <= 0.0f || fit.whiteShare_[f] < kLeastMatters))
            continue;
        unknownOf_[f] = static_cast<int>(pieceOf_.size());
        pieceOf_.push_back(f);
    }
    here_.log = std::move(start);
    if (here_.log.size() == model_.pieces + model_.outsides)
        here_.log.insert(here_.log.end(), camera.known.begin(), camera.known.end());
    slopes_.emplace(slopes());
}

/// Normal about what is known; else Cauchy about white: a burnt-out piece is a wall or a lamp of
/// whatever brightness, and a pull that grew with the distance would hold lamps back; but for what
/// is brighter than a bare bulb, each e-fold of which is one standard deviation. It weighs more the
/// more of a piece shows a colour, for much more than white is white in all channels.
LightFitSearch::Prior LightFitSearch::priorOf(size_t unknown, const Point& point) const
{
    const bool isOutside = unknown >= pieceOf_.size();
    const double log = point.log[at(unknown)];
    if (isOutside && !model_.areSmallHoles(unknown - pieceOf_.size()))
        return openingPrior(at(unknown), point);
    if (!isOutside && emits_[pieceOf_[unknown]] == 0) {
        const double off = log - point.reflected[pieceOf_[unknown]];
        const double paper = off > 0.0 ? kWhiterPaper : kDarkerPaper;
        const double weight = 1.0 / (paper * paper);
        return {0.5 * weight * off * off, weight, weight * off};
    }
    if (!isOutside && prior_.log.empty()) {
        const size_t piece = pieceOf_[unknown];
        const double nats =
            kWhiteNats +
            (model_.coloured.empty() ? 0.0 : static_cast<double>(model_.coloured[piece]));
        const double weight = 2.0 * nats / (1.0 + log * log);
        // Of what was seen; a sun is brighter.
        const double over = model_.area[piece] > 0.0f ? std::max(log - kBareBulb, 0.0) : 0.0;
        return {nats * std::log1p(log * log) + 0.5 * over * over, weight + (over > 0.0 ? 1.0 : 0.0),
                weight * log + over};
    }
    const double off = log - (isOutside ? fit_.outside_ : prior_.log[pieceOf_[unknown]]);
    const double spread = !isOutside ? prior_.spread : off > 0.0 ? kOutsideMore : kOutsideSpread;
    const double weight = 1.0 / (spread * spread);
    return {0.5 * weight * off * off, weight, weight * off};
}

/// Cauchy about what scanners miss: small holes show what lies in shade, a window may show the sky.
LightFitSearch::Prior LightFitSearch::openingPrior(size_t log, const Point& point) const
{
    if (!prior_.log.empty()) {
        const double off = point.log[log] - prior_.log[log];
        const double weight = 1.0 / (prior_.spread * prior_.spread);
        return {0.5 * weight * off * off, weight, weight * off};
    }
    const double off = point.log[log] - fit_.outside_;
    const double weight = 2.0 * kOpeningNats / (1.0 + off * off);
    return {kOpeningNats * std::log1p(off * off), weight, weight * off};
}

/// What reflects, and is no unknown, sends what the light before makes of it, a bounce at a time.
void LightFitSearch::reflect(Point& at) const
{
    for (int bounce = 0; bounce < 3; ++bounce) {
        at.reflected = fit_.reflected(at.log);
        for (size_t f = 0; f < model_.pieces; ++f)
            if (unknownOf_[f] < 0) at.log[f] = at.reflected[f];
    }
}

void LightFitSearch::light(Point& at) const
{
    reflect(at);
    at.irradiance = fit_.irradiance(exponentials(at.log), 0, model_.shown.size());
    at.logIrradiance.resize(model_.shown.size());
    at.shown.resize(model_.shown.size());
    forEachChunk(at.logIrradiance.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            at.logIrradiance[i] = std::log(at.irradiance[i]);
            at.shown[i] = shown(at, i);
        }
    });
    at.nats = costOf(at);
}

double LightFitSearch::residual(const Point& at, MaterialPair pair) const
{
    return at.shown[pair.p] - at.shown[pair.q] - at.logIrradiance[pair.p] +
           at.logIrradiance[pair.q];
}

/// Mean slope of the inverse response between two places.
double LightFitSearch::slopeOf(const Point& at, MaterialPair pair) const
{
    double slope =
        0.5 * static_cast<double>(camera_.slopeKnown[pair.p] + camera_.slopeKnown[pair.q]);
    for (size_t k = 0; k < camera_.slopes(); ++k)
        slope += 0.5 * cameraAt(at, k) *
                 static_cast<double>(camera_.slopeAt(pair.p)[k] + camera_.slopeAt(pair.q)[k]);
    return std::max(slope, kFlattestSlope);
}

/// The texture is what was measured: a response that flattens it makes every pair agree, and pays
/// for that by the logarithm of its slope.
double LightFitSearch::costOfCamera(const Point& at) const
{
    double nats = 0.0;
    for (size_t k = 0; k < fit_.pairs_.size() && camera_.slopes() > 0; ++k)
        nats -= fit_.paintShare_[k] * perPair() * std::log(slopeOf(at, fit_.pairs_[k]));
    const size_t n = camera_.count();
    const std::vector<double> c = beyondExpected(at);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) nats += 0.5 * c[i] * camera_.precision[i * n + j] * c[j];
    return nats;
}

void LightFitSearch::addCamera(const Point& at, Normal& normal) const
{
    const auto first = static_cast<Eigen::Index>(lights());
    addSlopes(at, normal);
    const size_t n = camera_.count();
    const std::vector<double> c = beyondExpected(at);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            const double weight = camera_.precision[i * n + j];
            normal.matrix(first + static_cast<Eigen::Index>(i),
                          first + static_cast<Eigen::Index>(j)) += weight;
            normal.slope[first + static_cast<Eigen::Index>(i)] += weight * c[j];
        }
}

/// Of the logarithm of the slope.
void LightFitSearch::addSlopes(const Point& at, Normal& normal) const
{
    if (camera_.slopes() == 0) return;
    const auto n = static_cast<Eigen::Index>(camera_.slopes());
    const auto first = static_cast<Eigen::Index>(lights());
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd row(n);
    for (size_t i = 0; i < fit_.pairs_.size(); ++i) {
        const auto [p, q] = fit_.pairs_[i];
        const Eigen::Map<const Eigen::VectorXf> ofP(camera_.slopeAt(p).data(), n);
        const Eigen::Map<const Eigen::VectorXf> ofQ(camera_.slopeAt(q).data(), n);
        row = 0.5 / slopeOf(at, fit_.pairs_[i]) * (ofP + ofQ).cast<double>();
        const double weight = fit_.paintShare_[i] * perPair();
        products.noalias() += weight * row * row.transpose();
        sum -= weight * row;
    }
    normal.matrix.block(first, first, n, n) += products;
    normal.slope.segment(first, n) += sum;
}

/// How far the mean log albedo of all places is from a room's.
double LightFitSearch::level(const Point& at) const
{
    double sum = 0.0;
    for (size_t i = 0; i < model_.places(); ++i) sum += at.shown[i] - at.logIrradiance[i];
    return sum / static_cast<double>(model_.places()) +
           std::log(static_cast<double>(kPi / kUsualPaper));
}

/// That of a mean over rooms, each of which has a level of its own.
double LightFitSearch::spreadOfLevel() const
{
    return kAlbedoSpread / std::sqrt(model_.rooms);
}

double LightFitSearch::costOf(const Point& at) const
{
    const size_t pairs = fit_.pairs_.size();
    std::vector<double> sums((pairs + kPairsOfChunk - 1) / kPairsOfChunk, 0.0);
    forEachChunk(pairs, kPairsOfChunk, [&](size_t begin, size_t end) {
        SumOfLogs sum;
        for (size_t k = begin; k < end; ++k) {
            const double r = residual(at, fit_.pairs_[k]);
            const double off = r / (wider_ * fit_.noiseOf(k, r));
            sum.add(off * off);
        }
        sums[begin / kPairsOfChunk] = sum.value();
    });
    const double nats = std::accumulate(sums.begin(), sums.end(), fit_.normalization_);
    return perPair() * nats + costOfPriors(at);
}

double LightFitSearch::costOfPriors(const Point& at) const
{
    double nats = 0.0;
    for (size_t f = 0; f < model_.pieces; ++f)
        if (isBounded(f)) nats += fit_.boundCost(f, at.logIrradiance[model_.placeOf(f)]);
    for (size_t u = 0; u < lights(); ++u) nats += priorOf(u, at).cost;
    for (const MaterialPair pair : fit_.told_) nats += natsOfTold(residual(at, pair));
    if (camera_.count() > 0) nats += costOfCamera(at);
    for (const auto& [a, b] : fit_.alike_) {
        if (emits_[a] == 0 || emits_[b] == 0) continue;
        const double off = (at.log[a] - at.log[b]) / kAlikeSpread;
        nats += 0.5 * off * off;
    }
    const double off = level(at) / spreadOfLevel();
    return nats + 0.5 * off * off;
}

/// d E / d radiance at each place, by unknowns, and what the camera's do to the radiance shown; and
/// a row of zeros.
PackedRows LightFitSearch::slopes() const
{
    const size_t rows = model_.shown.size();
    const PackedLight& light = fit_.light_;
    std::vector<size_t> columnOf(lights()); // of unknowns, in `light`
    for (size_t k = 0; k < light.rows.columns(); ++k) {
        const bool isPiece = k < model_.pieces;
        const int u = isPiece ? unknownOf_[light.order[k]]
                              : static_cast<int>(pieceOf_.size() + k - model_.pieces);
        if (u >= 0) columnOf[static_cast<size_t>(u)] = k;
    }
    return {rows + 1, count(), [&](size_t i, std::span<float> row) {
                if (i == rows) return;
                light.rows.pick(i, columnOf, row);
                if (i < model_.places())
                    std::ranges::transform(camera_.bendAt(i),
                                           row.begin() + static_cast<ptrdiff_t>(lights()),
                                           std::negate());
            }};
}

/// Of all but what ties pieces to each other. `isBent`: by the second derivative of the loss, not
/// by the weight that its slope is worth.
LightFitSearch::Normal LightFitSearch::normalOfData(const Point& at, bool isBent) const
{
    const size_t rows = model_.shown.size();
    std::vector<float> perLight(rows + 1, 0.0f);
    for (size_t i = 0; i < rows; ++i) perLight[i] = static_cast<float>(1.0 / at.irradiance[i]);
    std::vector<PairResidual> weighed(fit_.pairs_.size());
    forEachChunk(weighed.size(), 2048, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            const double r = residual(at, fit_.pairs_[k]);
            const double noise = wider_ * fit_.noiseOf(k, r);
            const double weight = 2.0 * perPair() / (noise * noise + r * r);
            const double bent = isBent ? bentShare(r / noise) : 1.0;
            const double slope = std::sqrt(bent * weight);
            weighed[k] = {fit_.pairs_[k], static_cast<float>(slope),
                          static_cast<float>(weight * r / slope)};
        }
    });
    for (size_t f = 0; f < model_.pieces; ++f) {
        if (!isBounded(f)) continue;
        const size_t place = model_.placeOf(f);
        const double lack = fit_.lack(f, at.logIrradiance[place]);
        if (lack <= 0.0) continue;
        const double off = lack / kBoundNoise;
        const double flaw = fit_.flaw(f);
        const double wall = (1.0 - flaw) * std::exp(-0.5 * off * off);
        const double slope = std::sqrt(wall / (wall + flaw)) / kBoundNoise;
        weighed.push_back({{static_cast<uint32_t>(place), static_cast<uint32_t>(rows)},
                           static_cast<float>(slope),
                           static_cast<float>(slope * lack)});
    }
    for (const MaterialPair pair : fit_.told_)
        weighed.push_back({pair, static_cast<float>(1.0 / kFirstNoise),
                           static_cast<float>(residual(at, pair) / kFirstNoise)});
    const auto n = static_cast<Eigen::Index>(count());
    const std::vector<double> squares = squaresOf(*slopes_, lights(), perLight, weighed);
    const Eigen::Map<const RowMajor> all(squares.data(), n + 1, n + 1);
    Eigen::VectorXd radiance = Eigen::VectorXd::Ones(n); // d / d log
    for (size_t u = 0; u < lights(); ++u)
        radiance[static_cast<Eigen::Index>(u)] = std::exp(at.log[this->at(u)]);
    Normal normal{radiance.asDiagonal() * all.topLeftCorner(n, n) * radiance.asDiagonal(),
                  radiance.asDiagonal() * all.bottomLeftCorner(1, n).transpose()};
    addPriors(at, normal);
    addLevel(at, perLight, radiance, normal);
    if (camera_.count() > 0) addCamera(at, normal);
    return normal;
}

LightFitSearch::Normal LightFitSearch::normalAt(const Point& at, bool isBent) const
{
    Normal normal = normalOfData(at, isBent);
    addAlike(at, normal);
    return normal;
}

void LightFitSearch::addPriors(const Point& at, Normal& normal) const
{
    for (size_t u = 0; u < lights(); ++u) {
        const auto i = static_cast<Eigen::Index>(u);
        const Prior prior = priorOf(u, at);
        normal.matrix(i, i) += prior.weight;
        normal.slope[i] += prior.slope;
    }
}

void LightFitSearch::addAlike(const Point& at, Normal& normal) const
{
    for (const auto& [a, b] : fit_.alike_) {
        if (emits_[a] == 0 || emits_[b] == 0) continue;
        const double weight = 1.0 / (kAlikeSpread * kAlikeSpread);
        const Eigen::Index i = unknownOf_[a];
        const Eigen::Index j = unknownOf_[b];
        const double off = at.log[a] - at.log[b];
        normal.matrix(i, i) += weight;
        normal.matrix(j, j) += weight;
        normal.matrix(i, j) -= weight;
        normal.matrix(j, i) -= weight;
        normal.slope[i] += weight * off;
        normal.slope[j] -= weight * off;
    }
}

void LightFitSearch::addLevel(const Point& at, std::span<const float> perLight,
                              const Eigen::VectorXd& radiance, Normal& normal) const
{
    const size_t places = model_.places();
    const std::vector<double> sum = sumOf(*slopes_, lights(), perLight.first(places));
    Eigen::VectorXd row = -Eigen::Map<const Eigen::VectorXd>(sum.data(), normal.slope.size());
    row.array() *= radiance.array() / (static_cast<double>(places) * spreadOfLevel());
    normal.matrix += row * row.transpose();
    normal.slope += level(at) / spreadOfLevel() * row;
}

/// Nats gained; 0 where nothing near is better.
double LightFitSearch::step()
{
    // Numerics.
    constexpr int kAttempts = 6; // of a shorter step, each time by more damping
    const Normal normal = normalAt(here_, true);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        Eigen::MatrixXd damped = normal.matrix;
        damped.diagonal() *= 1.0 + damping_;
        const Eigen::VectorXd way = -damped.llt().solve(normal.slope);
        Point there = here_;
        for (size_t u = 0; u < count(); ++u)
            there.log[at(u)] +=
                std::clamp(way[static_cast<Eigen::Index>(u)], -kLongestStep, kLongestStep);
        light(there);
        const double gain = here_.nats - there.nats;
        if (gain > 0.0) {
            here_ = std::move(there);
            damping_ = std::max(damping_ * 0.2, 1e-6);
            return gain;
        }
        damping_ *= 10.0;
    }
    return 0.0;
}

void LightFitSearch::run(double widest, double most)
{
    for (wider_ = widest;; wider_ = std::max(0.5 * wider_, 1.0)) {
        damping_ = 1e-3;
        light(here_);
        for (int i = 0; i < kMostSteps; ++i) {
            const double gained = step();
            if (gained <= kConverged) break;
            if (wider_ <= 1.0 && here_.nats - kStillToCome * gained > most) return;
        }
        if (wider_ <= 1.0) return;
    }
}

LightEstimate LightFitSearch::estimate() const
{
    LightEstimate estimate{.log = here_.log, .nats = here_.nats};
    const auto lightsEnd =
        here_.log.begin() + static_cast<ptrdiff_t>(model_.pieces + model_.outsides);
    estimate.camera.assign(lightsEnd, here_.log.end());
    estimate.log.resize(model_.pieces + model_.outsides);
    return estimate;
}

LightEstimate LightFitSearch::result() const
{
    LightEstimate estimate = this->estimate();
    estimate.error.assign(here_.log.size(), 0.0);
    const Normal normal = normalAt(here_, false);
    const auto n = static_cast<Eigen::Index>(count());
    const Eigen::MatrixXd covariance = normal.matrix.llt().solve(Eigen::MatrixXd::Identity(n, n));
    if (camera_.count() > 0) {
        const auto l = static_cast<Eigen::Index>(lights());
        const Eigen::Map<const Eigen::MatrixXd> prior(camera_.precision.data(), n - l, n - l);
        estimate.occam =
            0.5 * (logDeterminant(normal.matrix) -
                   logDeterminant(normal.matrix.topLeftCorner(l, l)) - logDeterminant(prior));
        const Eigen::MatrixXd ofCamera = covariance.bottomRightCorner(n - l, n - l);
        estimate.cameraCovariance.assign(ofCamera.data(), ofCamera.data() + ofCamera.size());
    }
    for (Eigen::Index u = 0; u < n; ++u)
        estimate.error[at(static_cast<size_t>(u))] = std::sqrt(covariance(u, u));
    std::vector<double> sizes;
    for (const MaterialPair pair : fit_.pairs_) sizes.push_back(std::abs(residual(here_, pair)));
    estimate.residual = medianOfAll(std::move(sizes));
    return estimate;
}

/// Unknowns are shares of radiance here: what goes dark keeps what it reflects, and is no longer
/// like any other. Of a set that goes,
/// the cost is d^T (C_ss)^-1 d / 2 for the change d; then the others move by C_rs (C_ss)^-1 d.
std::vector<uint8_t> LightFitSearch::needless(std::span<const Removal> removals) const
{
    const auto n = static_cast<Eigen::Index>(count());
    Eigen::MatrixXd covariance =
        normalOfData(here_, false).matrix.llt().solve(Eigen::MatrixXd::Identity(n, n));
    Eigen::VectorXd change(n); // that each must still make to go
    for (size_t u = 0; u < pieceOf_.size(); ++u) {
        const double left = here_.reflected[pieceOf_[u]] - here_.log[pieceOf_[u]];
        change[static_cast<Eigen::Index>(u)] = std::min(std::exp(left), 1.0) - 1.0;
    }
    change.tail(static_cast<Eigen::Index>(model_.outsides + camera_.count())).setZero();
    std::vector<uint8_t> isGone(pieceOf_.size(), 0);
    std::vector<uint8_t> gone(removals.size(), 0);
    for (;;) {
        double least = 0.0;
        size_t best = removals.size();
        Eigen::MatrixXd bestMove; // C_.s (C_ss)^-1
        std::vector<Eigen::Index> bestSet;
        for (size_t k = 0; k < removals.size(); ++k) {
            std::vector<Eigen::Index> set;
            for (const uint32_t piece : removals[k].pieces)
                if (const int u = unknownOf_[piece]; u >= 0 && isGone[static_cast<size_t>(u)] == 0)
                    set.push_back(u);
            if (set.empty()) {
                gone[k] = 1;
                continue;
            }
            const Eigen::MatrixXd own = covariance(set, set);
            const Eigen::VectorXd d = change(set);
            const Eigen::LDLT<Eigen::MatrixXd> solver(own);
            const double nats = 0.5 * d.dot(solver.solve(d)) - removals[k].cost;
            if (nats >= least) continue;
            least = nats;
            best = k;
            bestSet = set;
            bestMove = solver.solve(covariance(set, Eigen::all)).transpose();
        }
        if (best == removals.size()) return gone;
        const Eigen::VectorXd moved = bestMove * change(bestSet);
        change -= moved;
        covariance -= bestMove * covariance(bestSet, Eigen::all);
        for (const Eigen::Index u : bestSet) isGone[static_cast<size_t>(u)] = 1;
        gone[best] = 1;
    }
}

} // namespace relamp
