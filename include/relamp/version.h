#pragma once

#include "relamp/api.h"

namespace relamp
{

/// "major.minor.patch" of the library.
RELAMP_API const char* version();

} // namespace relamp
