#pragma once

#include "fit/light_fit.h"

#include <cstddef>
#include <vector>

namespace relamp
{

/// What single pieces would gain at an estimate of the light, all else as it is. The fit must
/// outlive this.
class LightGain
{
public:
    LightGain(const LightFit& fit, const LightEstimate& estimate, const CameraColumns& camera = {});

    /// In nats, of a piece that did not emit and now does: by the best of a few radiances, which
    /// `log` receives; it stays as it is where the gain is not by its light.
    [[nodiscard]] double of(size_t piece, double& log) const;
    /// Log of a radiance to begin a fit from where only a fit can tell: the first of these, or as
    /// many times what the piece sends as the next is the last.
    [[nodiscard]] double leastOf(size_t piece) const;

private:
    struct LitPlace
    {
        uint32_t place;
        float direct; // > 0
    };

    [[nodiscard]] double firstTried(size_t piece) const;

    const LightFit& fit_;
    std::vector<double> radiance_;           // of pieces, then of parts outside
    std::vector<double> light_;              // irradiance of places
    std::vector<double> logAlbedo_;          // likewise
    std::vector<double> logShown_;           // likewise
    std::vector<std::vector<LitPlace>> lit_; // by each piece
};

} // namespace relamp
