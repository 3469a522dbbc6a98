#pragma once

#include "lights/json_document.h"
#include "relamp/lights.h"

#include <string>
#include <vector>

namespace relamp
{

/// What readLights reads, of a text that may stand anywhere.
Lights lightsFrom(const JsonDocument& document, std::vector<std::string>& warnings);

} // namespace relamp
