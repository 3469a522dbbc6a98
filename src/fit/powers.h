#pragma once

#include "fit/fit_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Two lamps that look like one model.
struct AlikeLamps
{
    uint32_t a;
    uint32_t b;
    float ratio = 1.0f; // by which a's radiance is expected to exceed b's, > 0
};

struct PowersOptions
{
    double priorWeight = 0.05; // of the pull of every lamp's luminance towards the texture's white,
                               // and of its channels towards its luminance, in pairs a place, >= 0
    double firstScale = 0.5;   // of the Cauchy loss, in log radiance; halves until lastScale
    double lastScale = 0.08;
    double tolerance = 1e-5; // share of the loss; a scale's fit ends when a step gains less
    bool oneChannel = false; // fit luminance alone: faster, for a first look
    std::vector<AlikeLamps> alike;
    double alikeWeight = 1e-4;    // of their being as expected, in pairs' squared residuals a pair
    std::vector<glm::vec3> start; // radiances of lamps, then of ambient; empty: without evidence
};

/// Radiances of lamps that make the walls uniform.
struct Powers
{
    std::vector<glm::vec3> radiance; // of each lamp, RGB
    std::vector<glm::vec3>
        logError;            // standard error of its logarithm; large where the data do not tell
    std::vector<float> told; // of each lamp, 0..1: how much the pairs narrowed the prior, in its
                             // least known channel; below 1/2 the prior says more than they do
    glm::vec3 ambient{0.0f}; // radiance from outside the scan
    float residual = 0.0f;   // median absolute deviation of a pair, in log radiance
    float loss = 0.0f;       // mean of the pairs' robust losses, in squares of the last scale
};

/// Fits the radiance of every lamp, and of what lies outside, so that pairs of one material get one
/// albedo (method.md 6): least squares over log (L_p / L_q) - log (E_p / E_q), Cauchy, from a wide
/// scale to a narrow one, so that pairs of different material drop out. Each channel by
/// itself; unknowns are logarithms, so nothing is negative. Places that are burnt out lift lamps,
/// not their colour, until no paper would need to be whiter than 0.9. What the data leave open
/// comes out at the texture's white.
Powers fitPowers(const FitData& data, std::span<const MaterialPair> pairs,
                 const PowersOptions& options = {});

} // namespace relamp
