#pragma once

#include <optional>

#include <glm/vec3.hpp>

namespace relamp
{

/// The parameters of Choi's system. What is left empty is derived from the scan.
struct ThesisOptions
{
    float emitterThreshold = 0.9f; // luminance from which a burnt-out texel is taken to shine, 0..1
    float expansion = 8.0f;        // radiance of white once the texture's range is expanded, >= 1
    int lightLevels = 6;           // 2^n lights, 0..10
    std::optional<glm::vec3> attenuation; // k0, k1, k2 of 1 / (k0 + k1 d + k2 d^2), d in m, >= 0
    std::optional<float> power;           // factor on all light, > 0
    std::optional<float> ambient;         // irradiance / pi, the same everywhere, >= 0
    std::optional<float> mergeDistance;   // m; lights closer than this share a shadow map, >= 0
    int rsmSize = 32;                     // pixels along a face of a reflective shadow map, 8..512
    int lpvSize = 32;                     // cells along the longest side of the room, 8..128
    int lpvSteps = 8;                     // 1..128
    float flattenReach = 1.5f;            // of the bilateral filter, in surfel sizes, 1..2
    float flattenRange = 0.2f; // of the bilateral filter, in square roots of radiance, > 0
    bool useLpv = true;        // false: no bounce light (figure 3 of the thesis)
    bool useAmbient = true;    // false: no ambient light (figure 4 of the thesis)

    bool operator==(const ThesisOptions&) const = default;
};

} // namespace relamp
