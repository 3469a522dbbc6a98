#pragma once

#include "image/write_image.h"
#include "relamp/camera.h"
#include "scan/rays.h"

#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relamp
{

/// The rays of a camera through a picture of some size.
class CameraRays
{
public:
    CameraRays(const Camera& camera, Size size) : position_(camera.position), size_(size)
    {
        const auto width = static_cast<float>(size.width);
        const auto height = static_cast<float>(size.height);
        const float reach = glm::tan(0.5f * camera.fieldOfView); // half of the picture, at 1 m
        const float pixel = 2.0f * reach / (camera.across == Across::width ? width : height);
        const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
        column_ = pixel * right;
        row_ = pixel * glm::cross(camera.forward, right);
        corner_ = camera.forward - 0.5f * width * column_ - 0.5f * height * row_;
    }

    [[nodiscard]] glm::vec3 position() const { return position_; }
    [[nodiscard]] Size size() const { return size_; }

    /// Through a point of the picture, in pixels; (0, 0) is its upper left corner.
    [[nodiscard]] Ray through(float x, float y) const
    {
        return {.origin = position_, .direction = glm::normalize(corner_ + x * column_ + y * row_)};
    }

private:
    glm::vec3 position_;
    Size size_;
    glm::vec3 column_{0.0f}; // from a pixel to its right neighbour, 1 m ahead
    glm::vec3 row_{0.0f};    // to the one below
    glm::vec3 corner_{0.0f};
};

/// Room to work in for lookAlong, to be used again.
struct RowOfRays
{
    std::vector<Ray> rays;
    std::vector<Hit> hits;
};

/// Calls `see(x, ray, hit)` for every pixel of row `y`, for `samples` rays through each: evenly, no
/// two in one row or column of it, one in the middle.
template<class See>
void lookAlong(int y, int samples, const CameraRays& camera, const RayScene& scene, RowOfRays& row,
               const See& see)
{
    const auto width = static_cast<size_t>(camera.size().width);
    row.rays.resize(width);
    row.hits.resize(width);
    const auto count = static_cast<float>(samples);
    for (int sample = 0; sample < samples; ++sample) {
        const float place = static_cast<float>(sample) - 0.5f * (count - 1.0f);
        const float dx = 0.5f + place / count;
        const float dy = glm::fract(0.5f + 0.618034f * place); // the golden ratio
        for (size_t x = 0; x < width; ++x)
            row.rays[x] = camera.through(static_cast<float>(x) + dx, static_cast<float>(y) + dy);
        scene.intersect(row.rays, row.hits, RayOrder::coherent);
        for (size_t x = 0; x < width; ++x) see(x, row.rays[x], row.hits[x]);
    }
}

} // namespace relamp
