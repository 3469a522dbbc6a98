#include "scan/wall_frame.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kBins = 360; // of a quarter turn
constexpr size_t kAround = 2; // bins on both sides of the fullest: half a degree
constexpr double kSteps =
    90.0; // of a quarter turn: a scan that stands about straight is not turned
constexpr double kQuarter = 0.5 * static_cast<double>(kPi);

/// Area of upright surface by the way it faces, up to quarter turns, as numbers of four times that
/// angle.
std::array<std::complex<double>, kBins> facings(const Scan& scan)
{
    std::array<std::complex<double>, kBins> bins{};
    for (const Mesh& mesh : scan.meshes)
        for (const auto& triangle : mesh.triangles) {
            const glm::vec3 a = mesh.positions[triangle[0]];
            const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.positions[triangle[1]] - a),
                                                 glm::dvec3(mesh.positions[triangle[2]] - a));
            const double level = std::hypot(normal.x, normal.z);
            if (level <= std::abs(normal.y)) continue;
            const double turn = std::atan2(normal.z, normal.x) / kQuarter;
            const double part = turn - std::floor(turn);
            const auto bin = static_cast<size_t>(part * static_cast<double>(kBins) + 0.5) % kBins;
            bins[bin] += std::polar(level, 4.0 * kQuarter * part);
        }
    return bins;
}

} // namespace

WallFrame::WallFrame(double turn)
    : cos_(static_cast<float>(std::cos(turn))), sin_(static_cast<float>(std::sin(turn)))
{}

WallFrame wallFrameOf(const Scan& scan)
{
    const auto bins = facings(scan);
    std::complex<double> most = 0.0;
    for (size_t bin = 0; bin < kBins; ++bin) {
        std::complex<double> around = 0.0;
        for (size_t k = 0; k <= 2 * kAround; ++k)
            around += bins[(bin + kBins + k - kAround) % kBins];
        if (std::abs(around) > std::abs(most)) most = around;
    }
    if (most == 0.0) return {};
    const double turn = std::round(std::arg(most) / (4.0 * kQuarter) * kSteps) / kSteps;
    return WallFrame(-turn * kQuarter);
}

} // namespace relamp
