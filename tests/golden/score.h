#pragma once

#include "relamp/lights.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp::golden
{

struct Picture
{
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> rgb; // linear
};

/// Reads EXR as linear, 8-bit files through sRGB.
Picture readPicture(const std::filesystem::path& file);

struct Score
{
    double psnr;      // of the albedo after one scale a channel, unclipped texels of the mask, dB
    double leakSlope; // of log(estimate / truth) over log(true shading): 1 = all shading is left, 0
                      // = none
};

/// What is known of a room, one value a texel of its texture.
struct Truth
{
    Picture albedo;
    std::vector<glm::vec3> shading; // in the texture's units; of what is not clipped
    Picture input;                  // the texture
    std::vector<uint8_t> isScored;
};

/// Of samples/bedroom.
Truth truthOfSample(const std::filesystem::path& room);
/// Of a folder of tests/rooms; its shading is texture / albedo.
Truth truthOfSmallRoom(const std::filesystem::path& room);

/// Scores an albedo against what is true.
Score scoreAlbedo(const Picture& albedo, const Truth& truth);

struct LampCount
{
    int found = 0;    // of the true lamps
    int notLamps = 0; // fixtures that are none of them
};

/// Compares fixtures with the room's gt_lights.json by where they are. Each is one lamp at most.
LampCount countLamps(const Lights& lights, const std::filesystem::path& room);

} // namespace relamp::golden
