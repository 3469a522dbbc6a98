#pragma once

#include "relamp/camera_model.h"

#include <string>

/// What a camera did, in words for a sentence; empty where nothing was found.
std::string deedsOf(const relamp::CameraModel& camera);
/// Likewise a gain that is rather an error of the light than of the camera's exposure.
std::string unexplainedBy(const relamp::CameraModel& camera);
