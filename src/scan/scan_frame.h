#pragma once

#include "relamp/scan.h"

namespace relamp
{

/// Takes the file's axes and units to metres, Y up.
glm::mat4 worldFromFile(const ScanOptions& options);

/// Whether the person asked to leave out meshes of this name.
bool isSkipped(const ScanOptions& options, const std::string& meshName);

} // namespace relamp
