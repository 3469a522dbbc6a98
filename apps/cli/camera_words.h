#pragma once

#include "relamp/camera_model.h"

#include <string>

/// What a camera did, in words for a sentence; empty where nothing was found.
std::string deedsOf(const relamp::CameraModel& camera);
