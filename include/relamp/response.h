#pragma once

#include "relamp/api.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// What a camera's response made of light, undone: a monotone curve from the linear values of a
/// texture to radiance, the same for its three channels, that leaves black and white where they are
/// (docs/method/camera.md).
///
/// Its slope, of the logarithm of radiance over that of the texture, is linear between knots and
/// constant below the first.
struct RELAMP_API Response
{
    static constexpr size_t kKnots = 5;
    static constexpr std::array<float, kKnots> kAt{-6.0f, -4.0f, -2.5f, -1.2f, 0.0f}; // stops below
                                                                                      // white

    std::array<float, kKnots> slope{1.0f, 1.0f, 1.0f, 1.0f, 1.0f}; // 0.1..10; 1: straight

    bool operator==(const Response&) const = default;

    [[nodiscard]] bool isStraight() const { return *this == Response{}; }
    /// How many stops of the texture a stop of light made in the mid-tones; 1: straight.
    [[nodiscard]] float contrast() const;
    /// Radiance, 1 = white, of a texture's linear value >= 0. What is burnt out stays as it is.
    [[nodiscard]] float operator()(float texture) const;
};

/// The response in a lights.json or a report.json, of another scan by the same camera perhaps, or
/// in a file of its own (docs/guide/scans.md). A lights file or a report whose camera has no curve
/// is straight.
/// `warnings` receives a sentence a key of the camera that is not known. Throws
/// Error(cannotRead | malformed) naming the file, the line and the key.
RELAMP_API Response readResponse(const std::filesystem::path& file,
                                 std::vector<std::string>& warnings);

} // namespace relamp
