#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/image.h"
#include "relamp/progress.h"
#include "relamp/verify.h"
#include "scan/linearization.h"
#include "scan/texels.h"
#include "shading/path_tracer.h"

#include <span>
#include <vector>

#include <glm/geometric.hpp>

namespace relamp
{

/// A texel as the scan has it, and rendered twice, by paths that know nothing of each other.
struct RenderedPlace
{
    float area = 0.0f;      // m^2; 0 where the texel is burnt out, and nothing else is set
    glm::vec3 scan{0.0f};   // without what the camera did
    glm::vec3 albedo{0.0f}; // as the result has it; above 1 where its shading fell short
    glm::vec3 first{0.0f};
    glm::vec3 second{0.0f};

    /// Mean of the channels, right on average without the paths' noise: what one rendering is off
    /// by chance has nothing to do with the other. May be negative.
    [[nodiscard]] double squaredError() const
    {
        return static_cast<double>(glm::dot(first - scan, second - scan)) / 3.0;
    }
};

/// Mean albedo, at most 1, over the texels of each surfel that are not burnt out; what is burnt out
/// nearly all over is guessed as the solvers do. `albedo` holds an image a page.
std::vector<glm::vec3> meanAlbedo(const Texels& texels, const SurfelRadiance& radiance,
                                  std::span<const Image> albedo);

/// A scan's surface as a result has it.
struct DelitSurface
{
    std::span<const Image> albedo; // one a page
    std::span<const float> lit{};  // of surfels, as correctionOf(); empty: all light is there
};

/// Renders texels that lie evenly over the scan, each by its own albedo (at most 1) under what of
/// the light that paths bring it is there, to be compared with what the scan shows once its camera
/// is undone.
std::vector<RenderedPlace> renderAgain(const Texels& texels, const PathTracer& tracer,
                                       const DelitSurface& surface,
                                       const Linearization& linearization,
                                       const VerifyOptions& options, Progress& progress);

/// Sets the figures of `result`: error, ratio and bins.
void compare(std::span<const RenderedPlace> places, Verification& result);

} // namespace relamp
