#pragma once

#include "relamp/api.h"
#include "relamp/inspect.h"

#include <cstddef>

namespace relamp
{

/// What a command takes.
struct Cost
{
    double bytes = 0.0;       // of memory, resident, at the peak
    double coreSeconds = 0.0; // of a core, summed over all threads
};

/// What the commands will take of a scan, with default options on the CPU.
struct Estimate
{
    Cost delight;
    Cost verify;
    Cost relight; // one picture; by --no-transport, which keeps a third of its memory free
};

/// From what a scan is, and from how many lamps and windows a first look found in it; 0 where none
/// was taken. Fitted to measured runs (docs/dev/notebook.md, bench/costs.py), within 1.5 x of them;
/// seconds are those of a quiet core there, of which a busy or slower one takes more.
RELAMP_API Estimate estimate(const Inspection& found, size_t fixtures);

} // namespace relamp
