#pragma once

#include "relamp/api.h"
#include "relamp/image.h"
#include "relamp/progress.h"
#include "relamp/scan.h"
#include "relamp/thesis.h"

#include <vector>

namespace relamp
{

/// A scan's colours without their fine detail, a picture a page: what the thesis solver takes for
/// the colour of bounce light, by `flattenReach` and `flattenRange`. Pixels that no surface covers
/// are black. Throws Error(unsupported | cancelled) as delight does.
RELAMP_API std::vector<Image> flattened(const Scan& scan, const ThesisOptions& parameters,
                                        Progress& progress = unwatched());

} // namespace relamp
