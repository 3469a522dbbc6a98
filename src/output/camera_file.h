#pragma once

#include "relamp/camera.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// Reads a camera file, described in docs/guide/relighting.md. `warnings` receives a sentence a key
/// that is not known. Throws Error(cannotRead | malformed) naming the line and the key.
Camera readCamera(const std::filesystem::path& file, std::vector<std::string>& warnings);

} // namespace relamp
