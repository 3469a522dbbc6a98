#pragma once

#include "relamp/progress.h"
#include "scan/texels.h"

#include <cstdint>
#include <vector>

namespace relamp
{

struct EmitterOptions
{
    float threshold = 0.9f; // luminance from which a texel is taken to shine, 0..1
    float expansion = 8.0f; // radiance that white stands for once the range is expanded, >= 1
    float leastPower =
        0.005f; // share of the room's; weaker blobs are highlights and are dropped, 0..1
};

/// What all texels of a surfel that shine send out together.
struct Emitter
{
    glm::vec3 position{0.0f};  // mean, weighted by intensity
    glm::vec3 normal{0.0f};    // mean, unit
    glm::vec3 intensity{0.0f}; // expanded radiance * area, summed: what it sends along its normal
    float area = 0.0f;         // m^2
    uint32_t surfel = 0;
    int fixture = -1; // index of the connected blob that it belongs to
};

/// The light of the scan by surfel.
struct SurfelLight
{
    std::vector<glm::vec3> radiance; // mean of the texels that are neither clipped nor shine
    std::vector<float> area; // of these, m^2; 0 where there are none and radiance says nothing
    std::vector<Emitter> emitters; // ascending by surfel
};

/// Walks all texels once and sorts their light.
SurfelLight collectLight(const Texels& texels, const EmitterOptions& options, Progress& progress);

/// Joins emitters that touch into blobs, drops the weak ones, and numbers the rest by falling
/// power. Returns how many remain; `light.emitters` keeps only theirs.
int joinFixtures(SurfelLight& light, const Texels& texels, const EmitterOptions& options);

} // namespace relamp
