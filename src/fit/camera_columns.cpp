#include "fit/camera_columns.h"

#include "base/radiometry.shared.h"
#include "image/response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <Eigen/LU>

namespace relamp
{
namespace
{

// Of measured responses (Grossberg and Nayar 2004) and what raw developers apply: a contrast of 0.6
// to 1.5, and shoulders and toes beside it.
constexpr double kContrastSpread = 0.25; // of a slope, all together
constexpr double kShapeSpread = 0.2;     // of a slope by itself

std::vector<double> precisionOfSlopes()
{
    constexpr auto n = static_cast<Eigen::Index>(Response::kKnots);
    Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Constant(n, n, kContrastSpread * kContrastSpread);
    covariance.diagonal().array() += kShapeSpread * kShapeSpread;
    const Eigen::MatrixXd precision = covariance.inverse();
    return {precision.data(), precision.data() + precision.size()};
}

} // namespace

CameraColumns columnsOf(const Response& known, std::span<const glm::vec3> texture)
{
    constexpr size_t n = Response::kKnots;
    CameraColumns columns;
    for (const float slope : known.slope) columns.known.push_back(static_cast<double>(slope) - 1.0);
    columns.bend.assign(texture.size() * n, 0.0f);
    columns.slope.assign(texture.size() * n, 0.0f);
    columns.slopeKnown.assign(texture.size(), 0.0f);
    std::array<double, n> mean{};
    for (size_t i = 0; i < texture.size(); ++i) {
        float sum = 0.0f;
        for (int c = 0; c < 3; ++c) {
            const float weight = luminance(glm::vec3(c == 0, c == 1, c == 2)) * known(texture[i][c]);
            const auto bend = bendAt(texture[i][c]);
            const auto slope = slopeAt(texture[i][c]);
            for (size_t k = 0; k < n; ++k) {
                columns.bend[i * n + k] += weight * bend[k];
                columns.slope[i * n + k] += weight * slope[k];
            }
            sum += weight;
        }
        for (size_t k = 0; k < n; ++k) {
            columns.bend[i * n + k] /= std::max(sum, 1e-9f);
            columns.slope[i * n + k] /= std::max(sum, 1e-9f);
            columns.slopeKnown[i] += known.slope[k] * columns.slope[i * n + k];
            mean[k] += static_cast<double>(columns.bend[i * n + k]);
        }
    }
    for (size_t i = 0; i < texture.size(); ++i) // light that is gathered does not change
        for (size_t k = 0; k < n; ++k)
            columns.bend[i * n + k] -=
                static_cast<float>(mean[k] / static_cast<double>(texture.size()));
    columns.precision = precisionOfSlopes();
    return columns;
}

} // namespace relamp
