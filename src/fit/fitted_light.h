#pragma once

#include "fit/camera_columns.h"
#include "fit/light_model.h"
#include "relamp/camera_model.h"

#include <cstdint>
#include <span>

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
    TexturePlaces texture;                // a sun's rim, behind them, has none
    std::span<const MaterialPair> told{}; // that a person called one paint
    bool isResponseKnown = false;         // a person knows it
};

} // namespace relamp
