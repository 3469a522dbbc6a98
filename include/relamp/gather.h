#pragma once

#include "relamp/response.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

enum class Quality {
    draft,    // coarse surfels, few rays: for a first look
    standard, // as exact as a photo texture deserves
    high      // four times the rays
};
/// Pixels of a draft's textures along a side, at most: ScanOptions::longestSide to read one with.
constexpr int kDraftSide = 512;

/// Two places, m, that are of one paint.
struct SamePaint
{
    glm::vec3 a{0.0f};
    glm::vec3 b{0.0f};

    bool operator==(const SamePaint&) const = default;
};

/// What a person may tell the default solver; it needs none of it.
struct GatherOptions
{
    Quality quality = Quality::standard;
    int rays = 0; // of a surfel, that look for bounce light, 4..1024; 0: by quality and the number
                  // of surfels
    int shadowRays = 0;            // of a place in a penumbra, to each lamp, 1..1024; 0: by quality
    std::vector<glm::vec3> lights; // places, m, that shine: what is burnt out there, or bright
    std::vector<glm::vec3> notLights; // places, m, that do not, though burnt out or bright
    std::vector<SamePaint> same;      // the surfaces nearest to these have one albedo
    std::vector<glm::vec3> white;     // places, m, whose albedo is about 0.87: the scale of all
    bool sun = true;                  // false: no sun is looked for
    std::optional<Response> response; // what the camera applied, if it is known; none: looked for
    bool gain = true;                 // false: its exposure was the same everywhere
    uint32_t seed = 1; // of where rays start and go and of which places are compared; the same seed
                       // gives the same result

    bool operator==(const GatherOptions&) const = default;
};

} // namespace relamp
