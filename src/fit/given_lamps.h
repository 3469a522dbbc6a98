#pragma once

#include "fit/lamps.h"
#include "lights/candidates.h"
#include "relamp/lights.h"

#include <span>

namespace relamp
{

/// The lamps of an edited lights.json. A fixture that still stands where one was found is that one,
/// with the file's radiance, and one that is about as large as a candidate there is that candidate;
/// any other shines from a disc that faces along its normal, or from a ball without one. A point
/// light of no fixture is a ball of its radius. What is dark is left out, and so is what was found
/// and the file does not name.
FoundLamps asGiven(const Lights& given, const FoundLamps& found,
                   std::span<const Candidate> candidates);

} // namespace relamp
