#pragma once

#include "relamp/scan.h"

#include <glm/vec3.hpp>

namespace relamp
{

/// Axes turned about the vertical so that most walls of a scan face along them. What is computed on
/// a grid along these comes out the same however the scan stands.
class WallFrame
{
public:
    WallFrame() = default; // the scan's own axes
    explicit WallFrame(double turn);

    [[nodiscard]] glm::vec3 fromScan(glm::vec3 v) const
    {
        return {cos_ * v.x - sin_ * v.z, v.y, sin_ * v.x + cos_ * v.z};
    }
    [[nodiscard]] glm::vec3 toScan(glm::vec3 v) const
    {
        return {cos_ * v.x + sin_ * v.z, v.y, cos_ * v.z - sin_ * v.x};
    }

private:
    float cos_ = 1.0f;
    float sin_ = 0.0f;
};

/// By area, to a degree, up to quarter turns; the scan's own axes where nothing stands upright.
WallFrame wallFrameOf(const Scan& scan);

} // namespace relamp
