#pragma once

#include "relamp/relight.h"
#include "relight/light_source.h"
#include "scan/rays.h"

#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// A light that was put up, as a thing in a picture: bulbs, panels and discs glow; points without
/// extent, suns and backs are not seen.
class SeenLamp
{
public:
    /// What a ray meets.
    struct Glow
    {
        float distance; // m
        glm::vec3 radiance;
    };

    /// `light` must have a surface.
    explicit SeenLamp(const NewLight& light);

    static bool hasSurface(const NewLight& light);

    [[nodiscard]] std::optional<Glow> along(const Ray& ray) const;

private:
    [[nodiscard]] std::optional<Glow> ofBulb(const Ray& ray) const;
    [[nodiscard]] std::optional<Glow> ofPanel(const Ray& ray) const;

    NewLight light_;
    glm::mat3 frame_;
    std::optional<LightSource> bulb_; // none: a panel
};

/// Those of the lights that are seen.
std::vector<SeenLamp> seenLamps(std::span<const NewLight> lights);

} // namespace relamp
