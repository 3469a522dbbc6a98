#pragma once

#include "relamp/scan.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace relamp::scenes
{

/// Linear radiance that a surface shows at a place.
using Paint = std::function<glm::vec3(glm::vec3 position, glm::vec3 normal)>;

/// A flat square in the xz plane, `side` metres long, facing +y, on a page of `pixels` squared that
/// it fills to its edges. u runs along x, v along z; corner (0, 0, 0) is u = v = 0.
Scan square(float side, int pixels, const Paint& paint);

/// The same square in two charts that meet at x = side / 2 in space and lie apart on the page.
Scan splitSquare(float side, int pixels, const Paint& paint);

/// The inside of a box from the origin to `size`: six walls, each a chart of its own of `pixels`
/// squared with padding around it, in one 3 x 2 atlas. Textures are half floats.
Scan room(glm::vec3 size, int pixels, const Paint& paint);

/// A parallelogram that is seen from where alongU x alongV points.
struct Panel
{
    glm::vec3 corner;
    glm::vec3 alongU;
    glm::vec3 alongV;

    [[nodiscard]] glm::vec3 normal() const;
    [[nodiscard]] glm::vec3 at(float u, float v) const { return corner + u * alongU + v * alongV; }
};

/// The inner walls of a box: floor, ceiling, x = 0, x = size.x, z = 0, z = size.z.
std::vector<Panel> wallsOf(glm::vec3 size);

/// Any panels, each a chart of its own as those of `room` are.
Scan panels(std::span<const Panel> panels, int pixels, const Paint& paint);

/// For what takes a scan over, where a test goes on with it.
std::shared_ptr<const Scan> copyOf(const Scan& scan);
/// The same room so often, each `apart` metres beside the last along x, with a page of its own.
Scan rowOf(const Scan& room, int count, float apart);

/// The same radiance everywhere.
Paint plain(glm::vec3 radiance);

} // namespace relamp::scenes
