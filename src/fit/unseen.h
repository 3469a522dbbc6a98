#pragma once

#include "fit/camera_columns.h"
#include "fit/light_model.h"
#include "relamp/camera_model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// A light that was fitted: what is decided of it, what it was fitted to and what came out.
struct FittedLight
{
    const LightModel& model;
    std::span<const MaterialPair> pairs;
    std::span<const AlikePieces> alike;
    double noise; // log: between places of one paint
    std::span<const uint8_t> emits;
    std::span<const double> log; // as LightEstimate has it
    const CameraModel& camera;
    TexturePlaces texture;
    std::span<const MaterialPair> told{}; // that a person called one paint
    bool isResponseKnown = false;         // a person knows it
};

/// By how much the log albedo of places is another where the fit does not look at them: one a
/// place of `texture`.
///
/// Five fits from the one that is given leave out the pairs of a fold each (scan/held_out.h), and a
/// sixth leaves out none, to compare with. The same pieces emit in the same gathered light; what
/// they emit, outside and the camera's gain, or else its response where it is not known, are found
/// anew.
std::vector<float> changeUnseen(const FittedLight& light, uint32_t seed);

} // namespace relamp
