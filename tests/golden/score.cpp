#include "golden/score.h"

#include "relamp/image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace relamp::golden
{
namespace
{

constexpr float kClipped = 0.98f;

float luminanceOf(glm::vec3 rgb)
{
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

float medianOf(const std::vector<glm::vec3>& values, int c)
{
    std::vector<float> channel;
    for (const glm::vec3& value : values) channel.push_back(value[c]);
    const auto middle = channel.begin() + static_cast<ptrdiff_t>(channel.size() / 2);
    std::nth_element(channel.begin(), middle, channel.end());
    return *middle;
}

/// Least-squares scale of one channel, with the estimate clamped to 1 as a picture would be: the
/// scoring that the figures in docs/guide/quality.md are made with, round for round.
float scaleOf(const std::vector<glm::vec3>& estimate, const std::vector<glm::vec3>& truth, int c)
{
    float scale = medianOf(truth, c) / std::max(medianOf(estimate, c), 1e-6f);
    for (int round = 0; round < 5; ++round) {
        double cross = 0.0;
        double square = 0.0;
        for (size_t i = 0; i < estimate.size(); ++i) {
            const double q = std::clamp(estimate[i][c], 0.0f, 1.0f / scale);
            cross += q * static_cast<double>(truth[i][c]);
            square += q * q;
        }
        scale = static_cast<float>(cross / std::max(square, 1e-12));
    }
    return scale;
}

double slopeOf(const std::vector<double>& x, const std::vector<double>& y)
{
    double mx = 0.0;
    double my = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        mx += x[i] / static_cast<double>(x.size());
        my += y[i] / static_cast<double>(x.size());
    }
    double xy = 0.0;
    double xx = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mx) * (y[i] - my);
        xx += (x[i] - mx) * (x[i] - mx);
    }
    return xy / xx;
}

} // namespace

Picture readPicture(const std::filesystem::path& file)
{
    const Image image = readImage(file);
    const Radiance radiance(image);
    Picture picture{image.width, image.height, std::vector<glm::vec3>(image.pixels())};
    for (size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = radiance[i];
    return picture;
}

Score scoreAlbedo(const Picture& albedo, const std::filesystem::path& room)
{
    const Picture truth = readPicture(room / "gt_albedo.exr");
    const Picture shading = readPicture(room / "gt_shading.exr");
    const Picture mask = readPicture(room / "mask.png");
    const Picture input = readPicture(room / "scan_recon.jpg");
    if (albedo.rgb.size() != truth.rgb.size())
        throw std::runtime_error("albedo has another size than the truth");

    std::vector<glm::vec3> estimate;
    std::vector<glm::vec3> wanted;
    std::vector<double> logShading;
    std::vector<uint8_t> isClipped;
    for (size_t i = 0; i < truth.rgb.size(); ++i) {
        const glm::vec3 in = input.rgb[i];
        if (mask.rgb[i].r < 0.2f) continue;
        estimate.push_back(albedo.rgb[i]);
        wanted.push_back(truth.rgb[i]);
        logShading.push_back(std::log(std::max(luminanceOf(shading.rgb[i]), 1e-4f)));
        isClipped.push_back(std::max({in.r, in.g, in.b}) >= kClipped);
    }
    const glm::vec3 scale(scaleOf(estimate, wanted, 0), scaleOf(estimate, wanted, 1),
                          scaleOf(estimate, wanted, 2));
    glm::vec3 mean(0.0f);
    for (const glm::vec3& rgb : estimate) mean += rgb / static_cast<float>(estimate.size());
    const float darkest = 1e-3f * (mean.r + mean.g + mean.b) / 3.0f;
    double squares = 0.0;
    std::vector<double> logError;
    std::vector<double> logShadingThere;
    for (size_t i = 0; i < estimate.size(); ++i) {
        if (isClipped[i]) continue;
        const glm::vec3 difference = glm::clamp(scale * estimate[i], 0.0f, 1.0f) - wanted[i];
        squares += static_cast<double>(glm::dot(difference, difference)) / 3.0;
        const glm::vec3 ratio = glm::max(estimate[i], darkest) / glm::max(wanted[i], 1e-4f);
        logError.push_back(static_cast<double>(luminanceOf(glm::log(ratio))));
        logShadingThere.push_back(logShading[i]);
    }
    const double mse = squares / static_cast<double>(logError.size());
    return {-10.0 * std::log10(mse), slopeOf(logShadingThere, logError)};
}

} // namespace relamp::golden
