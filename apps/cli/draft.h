#pragma once

#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

/// What a draft makes of a scan. Throws as delight().
inline relamp::Decomposition draftOf(const relamp::Scan& scan, relamp::Progress& progress)
{
    return relamp::delight(relamp::coarsened(scan, relamp::kDraftSide),
                           {.gather = {.quality = relamp::Quality::draft}}, progress);
}
