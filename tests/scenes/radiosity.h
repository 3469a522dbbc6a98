#pragma once

#include "scenes/scenes.h"

#include <vector>

namespace relamp::scenes
{

/// Irradiance at a place from a panel of radiance 1 that lies wholly before it and faces it, by
/// Lambert's formula for polygons: exact at any distance.
float irradianceFrom(const Panel& panel, glm::vec3 place, glm::vec3 normal);

/// Part of a wall that shines.
struct ShiningPanel
{
    Panel panel;
    glm::vec3 radiance{0.0f};
};

/// An empty box that flat lamps in its walls light, with all bounces: what a scan of it is compared
/// with. A box is convex, so everything sees everything and no ray is needed.
class LitBox
{
public:
    /// `albedo` paints the walls. Bounces are solved by radiosity on 16 x 16 patches a wall.
    LitBox(glm::vec3 size, std::vector<ShiningPanel> lamps, Paint albedo);

    /// What a photo of it holds: linear, clipped at 1, in 256 steps of sRGB.
    [[nodiscard]] glm::vec3 photo(glm::vec3 place, glm::vec3 normal) const;
    [[nodiscard]] glm::vec3 irradiance(glm::vec3 place, glm::vec3 normal) const;
    [[nodiscard]] bool isLamp(glm::vec3 place, glm::vec3 normal) const;

private:
    struct Patch
    {
        Panel panel;
        glm::vec3 albedo;
        glm::vec3 indirect{0.0f}; // irradiance
    };

    [[nodiscard]] glm::vec3 direct(glm::vec3 place, glm::vec3 normal) const;
    [[nodiscard]] glm::vec3 indirect(glm::vec3 place, glm::vec3 normal) const;
    void solve();

    std::vector<Panel> walls_;
    std::vector<ShiningPanel> lamps_;
    Paint albedo_;
    std::vector<Patch> patches_; // of walls, then rows along v, then along u
};

} // namespace relamp::scenes
