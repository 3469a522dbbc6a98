#pragma once

#include "base/random.h"
#include "lights/lamp_surface.h"
#include "scan/pixel_marks.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// All that light needs to know of a room to go about in it.
struct TracedRoom
{
    std::vector<glm::vec3> albedo;   // of surfels, both sides; 0..1
    std::vector<uint8_t> shines;     // of surfels; not 0: burnt-out texels are a lamp's
    std::vector<glm::vec3> emission; // of surfels: radiance of these texels
    PixelMarks isClipped;            // what is burnt out
    LampSurface lamps;
    glm::vec3 ambient{0.0f}; // radiance of what lies outside the scan
    // Share of `ambient` that comes from a direction; all of it where there is no such function.
    std::function<glm::vec3(glm::vec3 direction)> outside;
    // What a white surface shows at a place, right on average, of lights that no ray meets; or
    // none.
    std::function<glm::vec3(const TexelSite& place, Random& random)> unseenLights;
};

/// Shading, irradiance / pi, apart by where it comes from.
struct TracedShading
{
    glm::vec3 direct{0.0f};   // straight from lamps
    glm::vec3 indirect{0.0f}; // by way of surfaces, and ambient

    [[nodiscard]] glm::vec3 total() const { return direct + indirect; }
};

/// Unidirectional path tracing between matte, two-sided surfaces; right on average, whatever the
/// number of paths. Lamps are looked for twice, by points on them and by chance, and each find
/// counts as much as its way is the better one (Veach & Guibas 1995, balance heuristic), so none
/// counts double. Lamps do not reflect: what they would is in their radiance. The arguments must
/// outlive this. Thread safe.
class PathTracer
{
public:
    PathTracer(const Texels& texels, const RayScene& scene, const TracedRoom& room)
        : texels_(texels), scene_(scene), room_(room)
    {}

    [[nodiscard]] const TracedRoom& room() const { return room_; }
    /// Mean over `paths` >= 1 paths from a place.
    [[nodiscard]] TracedShading shade(const TexelSite& site, size_t paths, Random random) const;

private:
    struct Surface;

    [[nodiscard]] glm::vec3 fromLamps(const TexelSite& place, float share) const;
    [[nodiscard]] glm::vec3 fromUnseen(const TexelSite& place, Random& random) const;
    void follow(TexelSite place, glm::vec2 first, Random& random, TracedShading& sum) const;
    [[nodiscard]] Surface surfaceAt(const Ray& ray) const;
    [[nodiscard]] glm::vec3 metLamp(const TexelSite& place, const Surface& lamp) const;

    const Texels& texels_;
    const RayScene& scene_;
    const TracedRoom& room_;
};

} // namespace relamp
