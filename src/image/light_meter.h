#pragma once

#include "relamp/image.h"

#include <cstddef>

namespace relamp
{

/// Measures pictures as a camera does before it exposes them: all that it is shown count alike.
class LightMeter
{
public:
    /// A picture of linear half RGB. Its black pixels, holes and backs, do not count.
    void add(const Image& picture);

    /// Stops that bring the log-average luminance of what was added to middle grey: Reinhard,
    /// Stark, Shirley, Ferwerda, Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002,
    /// equations 1 and 2 with the key 0.18. Within -32..32; 0 where all was black.
    [[nodiscard]] float exposure() const;

private:
    double logs_ = 0.0; // sum of log2(luminance)
    size_t pixels_ = 0;
};

} // namespace relamp
