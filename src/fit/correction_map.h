#pragma once

#include "relamp/delight.h"
#include "scan/texels.h"

#include <filesystem>
#include <span>
#include <vector>

namespace relamp
{

/// What correctionOf() gives, one a surfel, on the texels of a page; empty where `lit` is.
CorrectionMap correctionMapOf(const Texels& texels, size_t page, std::span<const float> lit);

/// The same back, the mean over the texels of a surfel. `maps`: one a page; empty, or with any of
/// them empty: nothing was corrected, and the result is empty. Throws Error(sizeMismatch), which
/// names `folder` as where they come from, unless each has the size of its page.
std::vector<float> correctionBy(std::span<const CorrectionMap> maps, const Texels& texels,
                                const std::filesystem::path& folder = {});

} // namespace relamp
