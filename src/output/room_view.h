#pragma once

#include "output/camera_rays.h"
#include "relamp/image.h"
#include "relamp/progress.h"
#include "relight/seen_lamp.h"
#include "scan/charts.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What is seen beside the light on the walls, as radiance.
struct Surroundings
{
    std::function<glm::vec3(glm::vec3 direction)> beyond; // through holes; required
    std::vector<SeenLamp> lamps;
};

/// A room ready to be looked at, whatever light is on its walls. `texels` and `scene` must outlive
/// it.
class RoomView
{
public:
    RoomView(const Texels& texels, const RayScene& scene);

    [[nodiscard]] const Scan& scan() const { return *texels_.scan; }

    /// What a camera sees: linear radiance, row 0 on top, mean of `samples` x `samples` rays
    /// through every pixel. `pages` has the radiance of all texels, a picture a page of the scan.
    ///
    /// Between texels it is bilinear, and stays in the chart that is seen. Backs of surfaces are
    /// black; from outside the scan's box they are passed through, as if the room's near walls were
    /// taken away.
    [[nodiscard]] std::vector<glm::vec3> look(const CameraRays& camera, int samples,
                                              std::span<const Image> pages,
                                              const Surroundings& around, Progress& progress) const;

private:
    const Texels& texels_;
    const RayScene& scene_;
    Charts charts_;
    Bounds box_;
};

} // namespace relamp
