#pragma once

#include "relamp/relight.h"
#include "scan/texels.h"
#include "shading/lamp_patches.h"
#include "shading/rectangle_direct.h"

#include <memory>
#include <variant>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// How a light stands. Columns: along, across, direction.
glm::mat3 frameOf(const NewLight& light);

/// One way to a light: where to look, and what comes from there if nothing is in the way.
struct Look
{
    glm::vec3 direction{0.0f}; // unit
    float distance = 0.0f;     // m, to where the light begins
    float irradiance = 0.0f;   // of the whole light, were all of it like here; 0: look nowhere
};

/// A light by its place and shape, at emission 1: what shadows and falloff depend on.
class LightSource
{
public:
    /// A light as somebody put it up.
    explicit LightSource(const NewLight& light);
    /// A piece of surface.
    explicit LightSource(AreaLight surface);

    /// Irradiance at the texels of a block, nothing in the way. May write a group of lanes beyond.
    void open(const TexelBlock& block, float* irradiance,
              InstructionSet set = bestInstructionSet()) const;
    /// A way from a place on a surface to the point of the light that `share` (0..1) and `u`
    /// choose; the mean irradiance of evenly spread ones is that of the light.
    [[nodiscard]] Look look(glm::vec3 place, glm::vec3 normal, float share, glm::vec2 u) const;
    [[nodiscard]] bool isSun() const { return std::holds_alternative<Sun>(shape_); }
    /// Whether every point of it is the same: rays differ by where they start alone.
    [[nodiscard]] bool isPoint() const;
    /// Irradiance * d^2 / cos in a direction away from a light without extent; 0 for a sun. At a
    /// piece of surface, what a point sends all around that stands for it.
    [[nodiscard]] float intensityTowards(glm::vec3 direction) const;
    [[nodiscard]] glm::vec3 centre() const;

private:
    struct Bulb // point, spot, sphere
    {
        glm::vec3 position;
        glm::mat3 frame; // columns: along, across, direction
        float radius;
        float gain;     // intensity at emission 1
        float cosOuter; // of a spot; -2: shines all around
        float cosInner;
        std::shared_ptr<const LightProfile> profile;

        [[nodiscard]] float intensity(glm::vec3 away) const;
    };
    struct Surface
    {
        AreaLight light; // what looks go to
        std::variant<LampPatches, ShiningRectangle> extent;
        float off; // m that a ray ends before it
    };
    struct Sun
    {
        glm::vec3 towards;
        float radius; // rad
    };

    [[nodiscard]] Look lookAt(const Bulb& bulb, glm::vec3 place, glm::vec3 normal,
                              glm::vec2 u) const;
    [[nodiscard]] Look lookAt(const Surface& surface, glm::vec3 place, glm::vec3 normal,
                              float share) const;
    [[nodiscard]] Look lookAt(const Sun& sun, glm::vec3 normal, glm::vec2 u) const;

    std::variant<Bulb, Surface, Sun> shape_;
};

/// Whether shadows of both are the same.
bool sameShape(const NewLight& a, const NewLight& b);

} // namespace relamp
