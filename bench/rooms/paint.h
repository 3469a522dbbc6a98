#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace relamp::rooms
{

/// What a surface is painted with. All colours are diffuse albedo, linear Rec. 709.
struct Paint
{
    enum Pattern {
        plain,
        stripes, // of two colours
        checks,
        tiles,   // `second` is the grout
        planks,  // each a shade of its own between the two, with a grain
        cloth,   // noise between the two
        blotches // a painting: rectangles of many colours
    };

    Pattern pattern = plain;
    glm::vec3 first{0.5f};
    glm::vec3 second{0.5f};
    float size = 0.2f; // m, of what repeats
    uint64_t seed = 0;
};

/// Albedo at a place of a surface, 0.03..0.9 a channel: no paper is whiter, no wood blacker.
glm::vec3 albedoOf(const Paint& paint, glm::vec3 position, glm::vec3 normal);

/// Noise of about -1..1 that varies over one unit of `at`.
float noise(glm::vec3 at, uint64_t seed);

} // namespace relamp::rooms
