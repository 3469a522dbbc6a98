#pragma once

#include "image/response.h"
#include "lights/candidates.h"
#include "lights/fixture_labels.h"
#include "relamp/camera_model.h"
#include "relamp/gather.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"
#include "shading/hit_lists.h"
#include "shading/lamp_powers.h"
#include "shading/lamp_sight.h"
#include "shading/lit_sides.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// A lamp that the scan gives away by what it does to the walls, or a group of alike neighbours
/// where there are many.
struct FoundLamp
{
    std::vector<ClippedPatch> patches;
    glm::vec3 logError{0.0f};     // standard error of log power
    LampSight onSides{};          // by hit lists; empty: not looked at
    bool isSunlit = false;        // no lamp but a burnt-out patch of sun, which lights the room
    bool isDetermined = true;     // false: it lights too little that is seen to tell how bright
    std::vector<uint32_t> ends{}; // of each single lamp in `patches`; empty: it is one
    std::vector<FixtureLabel> labels{}; // of each of these; empty: none has one yet
};

/// The sun, by the patch that it throws into the room.
struct FoundSun
{
    Sun sun;
    RayScene outside;     // what stands before it
    LampSight onSides;    // by hit lists
    TexelMarks inShade{}; // see markShade
};

struct FoundLamps
{
    std::vector<FoundLamp> lamps; // by falling power
    LampPowers powers;            // of these, and of a sun once it is let in
    float residual = 0.0f;        // of the fit, in log radiance
    std::optional<FoundSun> sun{};
    CameraModel camera{};              // what it made of the light
    float gaps = 0.0f;                 // as Lights
    SlopeCovariance doubtOfResponse{}; // 0: it is known
    // By how much the log albedo of each of placesToLookAt(), and then of those that a person spoke
    // of, is another where no fit looks at it: fit/unseen.h. Empty: nothing was fitted.
    std::vector<float> changeUnseen{};
    std::vector<uint32_t> white{};        // surfels that a person called so
    std::vector<glm::vec3> nothingNear{}; // places of GatherOptions::lights and notLights that
                                          // nothing is burnt out near
    std::vector<std::string> warnings;
};

/// Decides by evidence which burnt-out pieces are lamps, and how bright they are.
///
/// All candidates are fitted as if they were lamps. One that comes out at about white lights
/// nothing: it is a wall. One whose brightness the others explain, within the error of its own, is
/// a wall too. What remains is fitted again, until nothing changes; pieces that touch and are about
/// equally bright become one lamp. What a person says of a place in `options` is not doubted;
/// where such a lamp lights too little to tell how bright it is, a warning says so; pairs of
/// places that are called one paint count as data. Beyond 96
/// candidates a room (`rooms` >= 1: how many there are, as roomsOf()), alike neighbours are one
/// unknown and come out as one FoundLamp.
FoundLamps findLamps(const Texels& texels, const RayScene& scene, const HitLists& hits,
                     const SurfelRadiance& radiance, const GatherOptions& options, double rooms,
                     Progress& progress);

/// The patches of each lamp of a group, or of the one that it is.
std::vector<std::span<const ClippedPatch>> singlesOf(const FoundLamp& lamp);

} // namespace relamp
