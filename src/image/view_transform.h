#pragma once

#include "relamp/view.h"

#include <glm/vec3.hpp>

namespace relamp
{

/// How linear light becomes a picture: exposure, then the view's curve, then sRGB.
///
/// Prepared once, asked a pixel at a time; thread safe.
class ViewTransform
{
public:
    explicit ViewTransform(const ViewOptions& options);

    /// Linear 0..1, what the screen shows, of linear radiance >= 0.
    [[nodiscard]] glm::vec3 displayed(glm::vec3 radiance) const;

private:
    View view_;
    float scale_; // of radiance
};

} // namespace relamp
