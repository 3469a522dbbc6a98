#pragma once

#include "fit/lamp_evidence.h"
#include "fit/light_fit.h"
#include "fit/pieces.h"
#include "fit/room_light.h"
#include "relamp/camera_model.h"
#include "scan/rays.h"
#include "shading/lit_sides.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace relamp
{

/// The light of a scan while its lamps, and what its camera did, are looked for.
struct SearchedLight
{
    LampEvidence evidence;
    bool isResponseKnown = false; // `camera` begins with it
    std::vector<Piece> pieces{};  // that may emit
    std::vector<uint8_t> emits{}; // of pieces
    PieceSights sights{};         // of pieces
    Kinship kin{};                // of pieces
    LightModel model{};           // of pieces, as `evidence` has places
    LightEstimate estimate{};
    std::vector<double> noise{}; // of rooms, log: between places of one paint
    OutsideLight outside{};
    CameraModel camera{}; // what `evidence` has undone

    /// One more piece, which is no other's kin.
    void add(Piece piece);
    /// Finds what pieces are to each other; once for those that are there.
    void relate(const RayScene& scene);
    /// What all pieces do at places, and what is gathered there.
    void observe() { model = evidence.modelOf(pieces, sights); }
    /// What is gathered alone, once it is another.
    void gatherAnew() { model = evidence.modelOf(pieces, sights, std::move(model.direct)); }
    /// A first light, by all that may emit.
    void begin();

    /// As rooms, with so many pairs a place. This light must outlive it, and `of`: its model, or
    /// that in one channel.
    [[nodiscard]] HouseLight house(size_t pairs) const { return house(pairs, model); }
    [[nodiscard]] HouseLight house(size_t pairs, const LightModel& of) const;
    /// Of all places, those that are a room's.
    [[nodiscard]] double shareOf(const RoomParts& room) const;
    [[nodiscard]] double noiseOfAll() const; // mean of rooms

    /// The light of all rooms, and how noisy their pairs are in it.
    void solve(const std::function<LightEstimate(const RoomLight&)>& estimateOf);
    /// Undoes what `camera` says now in what is shown and gathered; by how much that is brighter
    /// than before, log.
    double linearize();
    /// The same, and solves anew from radiances as they were before.
    void undoCamera(std::vector<double> log);
};

} // namespace relamp
