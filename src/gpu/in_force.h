#pragma once

#include "relamp/devices.h"

#include <string>

namespace relamp::gpu
{

/// What computes by now.
struct InForce
{
    EngineOptions engine; // cpu or gpu, and its name: "cpu" or the GPU's
    std::string note;     // a sentence where the CPU had to take over; else empty
};

} // namespace relamp::gpu
