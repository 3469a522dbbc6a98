#pragma once

#include "fit/fitted_light.h"
#include "fit/light_fit.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// What decides whether a piece emits, beside the light of its room: of Piece and Kinship.
struct Choosable
{
    bool isGiven = false;
    bool isUnseen = false;
    bool isOpening = false;
    double natsOfSize = 0.0;         // more to believe in it, for it is small; see natsOfSize()
    std::vector<uint32_t> model{};   // other pieces that look like it
    std::vector<uint32_t> leansOn{}; // larger ones that it may be a part of
};

/// Nats that it takes to believe that a lamp is one: its log odds among burnt-out pieces.
double natsOfLamp();
/// More where it has less than kCrumb of `area`, m^2, >= 0: the smaller, the more pieces are
/// specks, and as many times less likely is one a lamp.
double natsOfSize(float area);
/// Of this piece beside those that emit: none where one does that it is a part of, and one
/// of its model that emits speaks for it.
double natsToEmit(const Choosable& piece, std::span<const uint8_t> emits);

/// Which pieces emit, and how much.
struct ChosenLight
{
    std::vector<uint8_t> emits;
    LightEstimate estimate;
};

/// Decides which pieces of one room emit, from a light where more or fewer do: by trials without
/// each of them, and with each of those that the light asks for most. `camera`: what it may have
/// done that is no lamp's light.
ChosenLight chooseLamps(const FittedLight& light, std::span<const Choosable> pieces,
                        const CameraColumns& camera = {});

} // namespace relamp
