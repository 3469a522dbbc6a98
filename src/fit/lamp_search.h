#pragma once

#include "fit/lamp_evidence.h"
#include "fit/lamp_groups.h"
#include "fit/lamps.h"
#include "fit/light_fit.h"
#include "fit/pieces.h"
#include "fit/sun_trial.h"
#include "fit/told_paint.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// One search for the lamps of a scan, and for what its camera did: findLamps().
class LampSearch
{
public:
    LampSearch(const Texels& texels, const RayScene& scene, const HitLists& hits,
               const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
               Progress& progress);

    FoundLamps run();

private:
    void takeResponse(const Response& known);
    void takeCandidates(const GatherOptions& options, const SurfelRadiance& radiance);
    void addPieces(LampGroup group);
    void relatePieces();
    void observe();
    [[nodiscard]] LightFit fitOf(size_t pairs) const;
    [[nodiscard]] double costOf(uint32_t piece) const;
    [[nodiscard]] Removal removalOf(std::vector<uint32_t> pieces, double cost) const;
    [[nodiscard]] std::vector<Removal> removals() const;
    void choose(size_t pairs);
    void prune(const LightFit& fit);
    struct Addition
    {
        uint32_t piece = 0;
        double gain = 0.0; // nats
        double log = 0.0;  // radiance to start from
        LightEstimate estimate{};
    };
    [[nodiscard]] std::vector<size_t> apart(std::span<const std::vector<uint32_t>> sets) const;
    [[nodiscard]] std::vector<Addition> bestAdditions(const LightFit& fit) const;
    void drop(const LightFit& fit);
    bool grow(const LightFit& fit);
    void lookCloser();
    bool join();
    void findColors();
    [[nodiscard]] bool isBent() const { return curved_ > 0.0 || toned_ > 0.0; }
    [[nodiscard]] CameraColumns contrastColumns(bool isCurved,
                                                const std::optional<Gain>& around) const;
    [[nodiscard]] LightEstimate solveContrast(LightFit& fit, const LightEstimate& start,
                                              CameraColumns& columns, bool isCurved) const;
    [[nodiscard]] LightEstimate fitOfContrast(bool isCurved,
                                              const std::optional<Gain>& around) const;
    void findContrast();
    void bend(size_t pairs);
    [[nodiscard]] double findDrift();
    void undoDrift(LightEstimate found);
    void findGain();
    [[nodiscard]] std::vector<glm::vec3> albedo() const;
    void seeByCamera(std::vector<double> log);
    [[nodiscard]] static double noiseOf(const LightEstimate& estimate);
    void letSunIn(const LitSides& sides);
    void takeSun(FoundLamps& found);
    [[nodiscard]] std::vector<Piece> lamps() const;
    FoundLamps result();

    const Texels& texels_;
    const RayScene& scene_;
    const HitLists& hits_;
    bool isSunSought_;
    bool isResponseSought_; // else it is what `camera_` begins with
    bool isGainSought_;
    Progress::Stage stage_;
    std::vector<glm::vec3> nothingNear_; // see FoundLamps
    std::vector<std::string> warnings_;
    ToldPaint told_; // of surfels
    double rooms_;   // that there are, >= 1
    LampEvidence evidence_;
    std::vector<Piece> pieces_;
    std::vector<uint8_t> emits_; // of pieces
    PieceSights sights_;
    LightModel model_;
    Kinship kin_;
    LightEstimate estimate_;
    double noise_; // log: between places of one paint
    OutsideLight outside_;
    std::shared_ptr<const RayScene> beforeSun_; // what stands before it
    CameraModel camera_;
    double curved_ = 0.0; // how likely its response is not straight; 0: it is taken for that
    double toned_ = 0.0;  // likewise, that it mapped tones locally
    SlopeCovariance doubtOfResponse_{};
    std::optional<SunTrial> sun_; // the last piece
};

} // namespace relamp
