#pragma once

#include "lights/json_item.h"
#include "relamp/relight.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// The light that an object of a file says, as readRelighting reads it of a whole file. Files that
/// it names lie in `folder`.
Relighting relightingFrom(const JsonItem& top, const std::filesystem::path& folder,
                          const Lights& captured, std::vector<std::string>& warnings);

} // namespace relamp
