#pragma once

#include "lights/json_item.h"
#include "relamp/lights.h"

#include <optional>
#include <string>
#include <vector>

namespace relamp
{

/// The "sun" of a lights file, if it has one. Throws Error(malformed) naming the line and the key.
std::optional<Sun> sunOf(const JsonItem& top, std::vector<std::string>& warnings);

} // namespace relamp
