#pragma once

#include "solve/reevaluate.h"
#include "solve/solution.h"

#include <vector>

namespace relamp
{

/// How far a room's light is right.
struct Rating
{
    Closure closure;
    std::vector<SurfelTrust> trust;
};
Rating rate(const Texels& texels, const SolvedRoom& room);

/// What a solved room comes to. `asked`: the options that it was solved with.
Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    Rating rating);

} // namespace relamp
