#pragma once

#include "solve/reevaluate.h"
#include "solve/solution.h"

#include <vector>

namespace relamp
{

/// How well its light explains the scan.
Closure closureOf(const SolvedRoom& room);

/// What a solved room comes to. `asked`: the options that it was solved with.
Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    const Closure& closure);

} // namespace relamp
