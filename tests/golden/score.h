#pragma once

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

/// Scores an albedo against the ground truth in the folder of a sample room.
Score scoreAlbedo(const Picture& albedo, const std::filesystem::path& room);

} // namespace relamp::golden
