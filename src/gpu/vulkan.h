#pragma once

// Vulkan. The library calls it by way of volk, which looks for the loader when it is asked to: a
// machine without one still starts relamp. The viewer is linked to the loader, as Dear ImGui is,
// and calls that; volk's pointers, which have the same names, stay inside the library. So headers
// of src/gpu name Vulkan's types and call none of its functions.
#ifdef RELAMP_LINKS_VULKAN
#include <vulkan/vulkan.h>
#else
#include <volk.h>
#endif
