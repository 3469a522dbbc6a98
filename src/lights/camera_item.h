#pragma once

#include "lights/json_item.h"
#include "relamp/camera_model.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// A camera's model as lights.json and report.json have it; empty where it is neutral.
nlohmann::ordered_json cameraAsJson(const CameraModel& camera);

/// The "camera" of a lights file. Throws Error(malformed) naming the line and the key.
CameraModel cameraOf(const JsonItem& item, std::vector<std::string>& warnings);

} // namespace relamp
