#pragma once

#include "fit/camera_columns.h"
#include "fit/searched_light.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The search for what a camera did, beside that for the lamps (docs/method/camera.md). What it
/// finds is undone in the light at once.
class CameraSearch
{
public:
    /// What is not sought stays as `light.camera` has it. The light must outlive it.
    CameraSearch(SearchedLight& light, bool isResponseSought, bool isGainSought)
        : light_(light), isResponseSought_(isResponseSought), isGainSought_(isGainSought)
    {}

    /// How likely a response and local tone mapping are beside all pieces that may emit.
    void findContrast();
    /// Whether either is.
    [[nodiscard]] bool isBent() const { return curved_ > 0.0 || toned_ > 0.0; }
    /// Both again among the lamps so far, by so many pairs a place.
    void bend(size_t pairs);
    /// Whether exposure drifts, beside all pieces that may emit: what it may have done is unknown
    /// beside the light then, until lamps are known. Where the contrast is not sure, one that
    /// the drift hid is looked for.
    void expectDrift();
    /// What a drift of exposure may have done in a room; nothing where none is expected.
    [[nodiscard]] CameraColumns driftOf(const RoomLight& room) const;
    /// The drift of exposure and white balance among lamps that are known, in every room by itself,
    /// for what each shows is hardly lit by the others.
    void findGain();
    /// Of the slopes that are undone; 0: they are known.
    [[nodiscard]] const SlopeCovariance& doubt() const { return doubtOfResponse_; }

private:
    struct Drift
    {
        double evidence = 0.0;           // nats
        std::vector<LightEstimate> fits; // of rooms, with one
    };
    struct Contrast
    {
        double curved = 0.0; // how likely
        double toned = 0.0;  // likewise, locally
        LightEstimate curve; // if it is one
    };

    [[nodiscard]] CameraColumns contrastColumns(const TexturePlaces& places, bool isCurved,
                                                const std::optional<Gain>& around) const;
    [[nodiscard]] LightEstimate contrastOf(const RoomLight& room, bool isCurved,
                                           const std::optional<Gain>& around,
                                           const CameraColumns& beside, int rounds) const;
    [[nodiscard]] LightEstimate byOneCamera(const HouseLight& light,
                                            std::span<const LightEstimate> fits) const;
    [[nodiscard]] LightEstimate
    fitOfContrast(const HouseLight& light, std::span<const LightEstimate> fits, bool isToned) const;
    [[nodiscard]] Contrast
    contrastOf(const HouseLight& house,
               const std::function<CameraColumns(const RoomLight&)>& besideOf,
               double curvedNats) const;
    void undo(const Contrast& found);
    void findContrastBesideDrift();
    [[nodiscard]] std::vector<LightEstimate> gainFits(const RoomLight& room,
                                                      std::span<const CameraColumns> columns) const;
    [[nodiscard]] Drift driftBy(const HouseLight& house, std::span<const Gain> lattices) const;
    [[nodiscard]] double findDrift();
    void undoDrift(std::span<const RoomParts> rooms, std::span<const LightEstimate> found);
    [[nodiscard]] std::vector<std::vector<glm::vec3>> positionsByRoom() const;
    [[nodiscard]] std::vector<glm::vec3> albedo() const;
    void findWhiteBalance(double drifted);

    SearchedLight& light_;
    bool isResponseSought_;
    bool isGainSought_;
    double curved_ = 0.0; // how likely its response is not straight; 0: it is taken for that
    double toned_ = 0.0;  // likewise, that it mapped tones locally
    bool isDriftExpected_ = false;
    bool isBesideDrift_ = false; // the contrast was found beside a drift, and is fitted so
    SlopeCovariance doubtOfResponse_{};
};

} // namespace relamp
