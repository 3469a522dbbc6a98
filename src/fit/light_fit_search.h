#pragma once

#include "fit/light_fit.h"
#include "fit/squares.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace relamp
{

/// One search for the unknowns of a LightFit, with the light that the last of them give.
class LightFitSearch
{
public:
    LightFitSearch(const LightFit& fit, std::span<const uint8_t> emits, const EmissionPrior& prior,
                   std::vector<double> start, const CameraColumns& camera);

    /// Ends early where less than `most` nats will not be reached.
    void run(double widest, double most = std::numeric_limits<double>::infinity());
    [[nodiscard]] LightEstimate estimate() const; // without errors
    [[nodiscard]] LightEstimate result() const;
    [[nodiscard]] std::vector<uint8_t> needless(std::span<const Removal> removals) const;

private:
    struct Point // of the unknowns, at which the light is known
    {
        std::vector<double> log;       // of pieces, then of parts outside
        std::vector<double> reflected; // log radiance that pieces have if they only reflect
        std::vector<double> irradiance;
        std::vector<double> logIrradiance;
        std::vector<double> shown; // log radiance of places
        double nats = 0.0;
    };
    struct Normal
    {
        Eigen::MatrixXd matrix;
        Eigen::VectorXd slope;
    };

    void light(Point& at) const;
    void reflect(Point& at) const;
    [[nodiscard]] double residual(const Point& at, MaterialPair pair) const;
    [[nodiscard]] double costOf(const Point& at) const;
    [[nodiscard]] double costOfPriors(const Point& at) const;
    [[nodiscard]] PackedRows slopes() const;
    [[nodiscard]] Normal normalOfData(const Point& at, bool isBent) const;
    [[nodiscard]] Normal normalAt(const Point& at, bool isBent) const;
    void addPriors(const Point& at, Normal& normal) const;
    void addAlike(const Point& at, Normal& normal) const;
    void addLevel(const Point& at, std::span<const float> perLight, const Eigen::VectorXd& radiance,
                  Normal& normal) const;
    [[nodiscard]] double level(const Point& at) const;
    [[nodiscard]] double spreadOfLevel() const;
    double step();

    /// Burnt-out walls tell how bright the lamps are, and pairs alone of what colour: a wall of
    /// warm light burns out in red first.
    [[nodiscard]] bool isBounded(size_t piece) const
    {
        return emits_[piece] == 0 && prior_.log.empty();
    }
    [[nodiscard]] size_t lights() const { return pieceOf_.size() + model_.outsides; } // unknown
    [[nodiscard]] size_t count() const { return lights() + camera_.count(); } // of all unknowns
    [[nodiscard]] double cameraAt(const Point& at, size_t k) const // beyond what is known
    {
        return at.log[model_.pieces + model_.outsides + k] - camera_.known[k];
    }
    [[nodiscard]] std::vector<double> beyondExpected(const Point& at) const
    {
        std::vector<double> c;
        for (size_t k = 0; k < camera_.count(); ++k)
            c.push_back(cameraAt(at, k) + camera_.known[k] - camera_.expected[k]);
        return c;
    }
    [[nodiscard]] double shown(const Point& at, size_t place) const
    {
        double log = fit_.logShown_[place];
        if (camera_.count() > 0 && place < model_.places())
            for (size_t k = 0; k < camera_.count(); ++k)
                log += cameraAt(at, k) * static_cast<double>(camera_.bendAt(place)[k]);
        return log;
    }
    [[nodiscard]] double perPair() const { return camera_.worth * fit_.perPair(); }
    [[nodiscard]] double slopeOf(const Point& at, MaterialPair pair) const;
    void addCamera(const Point& at, Normal& normal) const;
    void addSlopes(const Point& at, Normal& normal) const;
    [[nodiscard]] double costOfCamera(const Point& at) const;
    [[nodiscard]] size_t at(size_t unknown) const // its place in logs
    {
        return unknown < pieceOf_.size() ? pieceOf_[unknown]
                                         : model_.pieces + unknown - pieceOf_.size();
    }
    struct Prior
    {
        double cost;
        double weight; // of a squared step
        double slope;
    };
    [[nodiscard]] Prior priorOf(size_t unknown, const Point& point) const;
    [[nodiscard]] Prior openingPrior(size_t log, const Point& point) const;

    const LightFit& fit_;
    const LightModel& model_;
    std::span<const uint8_t> emits_;
    const EmissionPrior& prior_;
    const CameraColumns& camera_;
    std::vector<size_t> pieceOf_;      // of unknowns; the parts outside come behind
    std::vector<int> unknownOf_;       // of pieces; < 0: it reflects as its paint is expected to
    std::optional<PackedRows> slopes_; // of light by radiance; of what is shown, by the camera
    double wider_ = 1.0;
    double damping_ = 1e-3;
    Point here_;
};

/// Sum of log(1 + x) for many x >= 0, by few logarithms.
class SumOfLogs
{
public:
    void add(double x)
    {
        product_ *= 1.0 + x;
        if (product_ < kLarge) return;
        sum_ += std::log(product_);
        product_ = 1.0;
    }
    [[nodiscard]] double value() const { return sum_ + std::log(product_); }

private:
    // Numerics.
    static constexpr double kLarge = 1e100; // and another factor may be as large

    double sum_ = 0.0;
    double product_ = 1.0;
};

/// Of a positive definite one.
double logDeterminant(const Eigen::MatrixXd& matrix);
/// 0 of none.
double medianOfAll(std::vector<double> values);
std::vector<double> exponentials(std::span<const double> log);
/// Against a residual of places that a person called one paint. Such a pair is no one of many that
/// err alike, and none that is thrown away.
inline double natsOfTold(double residual)
{
    return 0.5 * residual * residual / (kFirstNoise * kFirstNoise);
}

} // namespace relamp
