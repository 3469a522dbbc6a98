#pragma once

#include "relamp/relight.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace relamp
{

/// How a luminaire shines, as its maker measured it: the photometric web of an IES file
/// (ANSI/IES LM-63).
struct IesPhotometry
{
    // Gains are luminous intensities, cd, with multiplier and ballast factor. The vertical angle is
    // 0 along the light's direction (straight down as measured), the horizontal one 0 along the
    // luminaire; what the file leaves to symmetry is filled in.
    std::shared_ptr<const LightProfile> profile;
    float lumens = 0.0f; // all light that leaves it; > 0
    float peak = 0.0f;   // cd, the strongest intensity; > 0
};

/// Reads the text of an IES file, LM-63 of 1986 to 2019, photometry of Type C. `name` is what to
/// call it in an error. Throws Error(malformed | unsupported) with a sentence on anything else.
IesPhotometry parseIes(std::span<const std::byte> text, const std::string& name);

/// The same of a file. Throws Error(cannotRead), too.
IesPhotometry readIes(const std::filesystem::path& file);

} // namespace relamp
