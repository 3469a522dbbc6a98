#include "golden/score.h"

#include "relamp/image.h"
#include "relamp/scan.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

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

Picture pictureOf(const Image& image)
{
    const Radiance radiance(image);
    Picture picture{image.width, image.height, std::vector<glm::vec3>(image.pixels())};
    for (size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = radiance[i];
    return picture;
}

} // namespace

Picture readPicture(const std::filesystem::path& file)
{
    return pictureOf(readImage(file));
}

Truth truthOfSample(const std::filesystem::path& room)
{
    Truth truth{readPicture(room / "gt_albedo.exr"), readPicture(room / "gt_shading.exr").rgb,
                readPicture(room / "scan_recon.jpg")};
    for (const glm::vec3& rgb : readPicture(room / "mask.png").rgb)
        truth.isScored.push_back(rgb.r >= 0.2f);
    return truth;
}

Truth truthOfSmallRoom(const std::filesystem::path& room)
{
    Progress progress;
    const Scan scan = readScan(room / "scan.glb", {}, progress);
    Truth truth{readPicture(room / "gt_albedo.png"), {}, pictureOf(scan.pages.at(0).image)};
    for (size_t i = 0; i < truth.albedo.rgb.size(); ++i) {
        const glm::vec3 albedo = truth.albedo.rgb[i];
        truth.isScored.push_back(albedo.g > 0.0f); // nothing is black
        truth.shading.push_back(truth.input.rgb[i] / glm::max(albedo, 1e-3f));
    }
    return truth;
}

Score scoreAlbedo(const Picture& albedo, const Truth& truth)
{
    if (albedo.rgb.size() != truth.albedo.rgb.size())
        throw std::runtime_error("albedo has another size than the truth");

    std::vector<glm::vec3> estimate;
    std::vector<glm::vec3> wanted;
    std::vector<double> logShading;
    std::vector<uint8_t> isClipped;
    for (size_t i = 0; i < albedo.rgb.size(); ++i) {
        const glm::vec3 in = truth.input.rgb[i];
        if (truth.isScored[i] == 0) continue;
        estimate.push_back(albedo.rgb[i]);
        wanted.push_back(truth.albedo.rgb[i]);
        logShading.push_back(std::log(std::max(luminanceOf(truth.shading[i]), 1e-4f)));
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

LampCount countLamps(const Lights& lights, const std::filesystem::path& room)
{
    constexpr float kOff = 0.15f; // m that a fixture's centre may be off, beside half its lamp
    struct TrueLamp
    {
        glm::vec3 centre;
        float reach;
    };
    std::vector<TrueLamp> missing;
    const auto truth = nlohmann::json::parse(std::ifstream(room / "gt_lights.json"));
    for (const auto& lamp : truth["lights"])
        missing.push_back({{lamp["center"][0], lamp["center"][1], lamp["center"][2]},
                           0.5f * std::sqrt(lamp["area"].get<float>()) + kOff});
    LampCount count;
    for (const Fixture& fixture : lights.fixtures) {
        const auto off = [&](const TrueLamp& lamp) {
            return glm::distance(lamp.centre, fixture.centre) / lamp.reach;
        };
        const auto nearest =
            std::min_element(missing.begin(), missing.end(),
                             [&](const TrueLamp& a, const TrueLamp& b) { return off(a) < off(b); });
        if (nearest == missing.end() || off(*nearest) > 1.0f) {
            ++count.notLamps;
            continue;
        }
        missing.erase(nearest);
        ++count.found;
    }
    return count;
}

} // namespace relamp::golden
