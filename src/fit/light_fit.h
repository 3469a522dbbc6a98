#pragma once

#include "fit/light_model.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

// Of walls that are burnt out and do not emit.
inline constexpr double kBoundNoise = 0.6; // log: of the light on a wall that is burnt out
// Chance that such a wall has not the light for it, polished or mixed with a lamp by the texture,
// where it is a speck, or not exposed as the rest where it fades; of a larger one that ends sharply
// less, as its area.
inline constexpr double kFlawOfSpeck = 0.3;

// Numerics.
inline constexpr double kLeastMatters = 0.001; // of the light at places: what sends less changes
                                               // nothing

// Numerics.
inline constexpr double kFirstWidth = 4.0; // times the noise: what a first loss forgives

// Log albedo, between places of one paint, before it is measured; and between those that a person
// calls so. No more where much is wrong with the light, for there it is needed.
inline constexpr double kFirstNoise = 0.08;

/// How bright everything is that the light of a room comes from, in luminance or in one channel: in
/// logarithms of radiance, 1 = the texture's white.
struct LightEstimate
{
    std::vector<double> log;    // of pieces, what they emit or reflect; then of what lies outside
    std::vector<double> error;  // standard errors of these; 0 of what reflects as it is expected to
    std::vector<double> camera; // coefficients of CameraColumns; empty where none are sought
    std::vector<double> cameraCovariance; // of these, count * count
    double occam = 0.0;    // nats that the camera's coefficients cost by what the data narrow them
    double nats = 0.0;     // of data and priors: the less, the likelier
    double residual = 0.0; // median absolute deviation of a pair

    [[nodiscard]] std::vector<double> start() const; // of another fit: log, and behind it camera
};

/// What is believed of pieces that emit before a look at the pairs.
struct EmissionPrior
{
    std::vector<double> log; // of pieces, within `spread`; empty: about white, and seldom much more
    double spread = 0.0;
};

/// A piece that emits, with those that would go dark with it.
struct Removal
{
    std::vector<uint32_t> pieces;
    double cost = 0.0; // nats that are saved
};

/// Radiances that give places of one paint one albedo (method.md 6), as a maximum a posteriori
/// estimate by Levenberg and Marquardt's method.
///
/// A piece that emits has a radiance of its own. One that does not sends what it reflects of all
/// the others' light, and no less than it shows: light for that it must get, which is a one-sided
/// bound. Unknowns are logarithms, so nothing is negative.
class LightFit
{
public:
    /// All but `noise` must outlive this: the difference in log albedo between places of one paint
    /// that is usual, > 0. `channel` < 0: luminance.
    LightFit(const LightModel& model, std::span<const MaterialPair> pairs,
             std::span<const AlikePieces> alike, double noise, int channel = -1);

    /// Pieces so bright that each brings its share of what is gathered, and outside what is in
    /// shade.
    [[nodiscard]] std::vector<double> beginning() const;
    /// From now on dark places count less, by what may leak to them beside this light: little or
    /// much, as the pairs have it. How likely much: that the mesh stands open as a reconstruction,
    /// 0..1.
    double expectLeaks(std::span<const double> log);
    /// The same of what is shown once these coefficients of the camera are undone; with a camera
    /// that has any, of nothing as well, where the pairs are for that beyond doubt.
    double expectLeaks(const LightEstimate& estimate, const CameraColumns& camera);
    /// How likely the mesh has gaps, as Lights, in this light: by pairs that are too dark in the
    /// dark, in the mean and not by their noise alone. What is expected from now on is undefined.
    double gaps(std::span<const double> log);
    /// From now on these pairs count as well, which a person said to be of one paint.
    void believe(std::span<const MaterialPair> same) { told_ = same; }
    /// `emits`: one flag a piece. `start`: as LightEstimate::log, or LightEstimate::start()
    /// with this camera. `widest`: how many times wider than its noise the first loss
    /// is: the more, the farther off the start may be.
    [[nodiscard]] LightEstimate solve(std::span<const uint8_t> emits, std::vector<double> start,
                                      double widest, const EmissionPrior& prior = {}) const;
    /// The same by a narrow loss, and without errors, for an estimate that is of use with less than
    /// `most` nats alone: the search ends where it will not get there.
    [[nodiscard]] LightEstimate trial(std::span<const uint8_t> emits, std::vector<double> start,
                                      double most, const CameraColumns& camera = {}) const;
    /// The same with what the camera did as further unknowns.
    [[nodiscard]] LightEstimate solve(std::span<const uint8_t> emits, std::vector<double> start,
                                      const CameraColumns& camera, double widest = 1.0) const;
    /// Which of `removals` the rest explains, by the quadratic form of the cost at the estimate:
    /// the least needed goes, all others take its part, and so on. One flag each.
    [[nodiscard]] std::vector<uint8_t> needless(const LightEstimate& estimate,
                                                std::span<const uint8_t> emits,
                                                std::span<const Removal> removals,
                                                const CameraColumns& camera = {}) const;
    /// Log radiance of pieces if they only reflect, in this light.
    [[nodiscard]] std::vector<double> reflected(std::span<const double> log) const;
    /// Nats of the pairs from `first` on.
    [[nodiscard]] double costOfPairs(size_t first, std::span<const double> log) const;
    /// Log albedo of places by such an estimate, luminance: with a camera that is `camera` at the
    /// coefficients of the estimate.
    [[nodiscard]] std::vector<double> logAlbedo(const LightEstimate& estimate,
                                                const CameraColumns& camera) const;
    /// How many independent ones all pairs are worth.
    static double effectivePairs(const LightModel& model);

private:
    friend class LightFitSearch;
    friend class LightGain;
    // Numerics.
    static constexpr double kUnbounded = 1e6; // log: noise of what tells nothing
    [[nodiscard]] double pick(glm::vec3 rgb) const;
    /// Of places [first, end) by these radiances, > 0.
    [[nodiscard]] std::vector<double> irradiance(std::span<const double> radiance, size_t first,
                                                 size_t end) const;
    [[nodiscard]] double flaw(size_t piece) const;
    [[nodiscard]] double boundCost(size_t piece, double logIrradiance) const;
    [[nodiscard]] double lack(size_t piece, double logIrradiance) const;
    [[nodiscard]] double noiseOf(size_t pair, double residual) const
    {
        if (residual > 0.0) return noiseAbove_[pair];
        const bool isBound = !model_.isBurntOut.empty() && model_.isBurntOut[pairs_[pair].p] != 0;
        return isBound ? kUnbounded : noiseBelow_[pair];
    }
    [[nodiscard]] double perPair() const;
    double costOfLeak(double leak, std::span<const double> light,
                      std::span<const double> logAlbedo);

    const LightModel& model_;
    PackedLight light_;
    std::span<const MaterialPair> pairs_;
    std::span<const AlikePieces> alike_;
    std::span<const MaterialPair> told_;
    int channel_;
    double noise_;
    std::vector<double> logShown_;   // of places, and then of pieces
    std::vector<double> gathered_;   // likewise
    std::vector<double> noiseAbove_; // of pairs, where p's albedo is above q's
    std::vector<double> noiseBelow_;
    std::vector<double> paintShare_; // of pairs: of their variance, what is paint and not light
    std::vector<double> whiteShare_; // of pieces: of the light at places, were they white
    double normalization_;           // sum over pairs of the log of their mean noise
    double outside_ = 0.0;           // log radiance that is expected there
};

} // namespace relamp
