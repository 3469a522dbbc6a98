#pragma once

// Vulkan by way of volk, which looks for the loader when it is asked to: a machine without one
// still starts relamp.
#include <volk.h>
