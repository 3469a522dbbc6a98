#pragma once

#include "fit/lamp_choice.h"
#include "fit/lamp_evidence.h"
#include "fit/lamp_groups.h"
#include "fit/lamps.h"
#include "fit/light_fit.h"
#include "fit/pieces.h"
#include "fit/room_light.h"
#include "fit/sun_trial.h"
#include "fit/told_paint.h"

#include <cstddef>
#include <cstdint>
#include <functional>
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
    void addPieces(LampGroup group, const SurfelRadiance& radiance);
    void relatePieces();
    void observe();
    [[nodiscard]] std::vector<Choosable> choosable(std::span<const uint32_t> ofRoom) const;
    void choose(size_t pairs);
    void solve(const std::function<LightEstimate(const RoomLight&)>& estimateOf);
    void lookCloser();
    bool join();
    void dropFaint();
    [[nodiscard]] LightEstimate colorOf(int channel) const;
    void findColors();
    [[nodiscard]] bool isBent() const { return curved_ > 0.0 || toned_ > 0.0; }
    [[nodiscard]] double shareOf(const RoomParts& room) const;
    [[nodiscard]] CameraColumns contrastColumns(const TexturePlaces& places, bool isCurved,
                                                const std::optional<Gain>& around) const;
    [[nodiscard]] LightEstimate contrastOf(const RoomLight& room, bool isCurved,
                                           const std::optional<Gain>& around, int rounds) const;
    [[nodiscard]] LightEstimate byOneCamera(const HouseLight& light,
                                            std::span<const LightEstimate> fits) const;
    [[nodiscard]] LightEstimate fitOfContrast(const HouseLight& light,
                                              std::span<const LightEstimate> fits, bool isCurved,
                                              bool isToned) const;
    void findContrast();
    void bend(size_t pairs);
    [[nodiscard]] HouseLight houseLight(size_t pairs) const;
    [[nodiscard]] HouseLight houseLight(size_t pairs, const LightModel& model) const;
    [[nodiscard]] std::vector<LightEstimate> gainFits(const RoomLight& room,
                                                      std::span<const CameraColumns> columns) const;
    [[nodiscard]] double findDrift();
    void undoDrift(std::span<const RoomParts> rooms, std::span<const LightEstimate> found);
    [[nodiscard]] std::vector<std::vector<glm::vec3>> positionsByRoom() const;
    void findGain();
    void findWhiteBalance(double drifted);
    [[nodiscard]] std::vector<float> changeUnseen() const;
    [[nodiscard]] float gaps() const;
    [[nodiscard]] std::vector<glm::vec3> albedo() const;
    void seeByCamera(std::vector<double> log);
    [[nodiscard]] double noiseOfAll() const;
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
    std::vector<double> noise_; // of rooms, log: between places of one paint
    OutsideLight outside_;
    std::optional<RayScene> beforeSun_; // what stands before it
    CameraModel camera_;
    double curved_ = 0.0; // how likely its response is not straight; 0: it is taken for that
    double toned_ = 0.0;  // likewise, that it mapped tones locally
    SlopeCovariance doubtOfResponse_{};
    std::optional<SunTrial> sun_; // the last piece
};

} // namespace relamp
