#pragma once

#include "scenes/radiosity.h"

namespace relamp::scenes
{

/// An empty room with a ceiling panel and a window, which is a hole in the wall x = kSize.x or a
/// pane in it. The sun throws a patch through it on the floor.
struct SunRoom
{
    static constexpr glm::vec3 kSize{4.0f, 2.5f, 5.0f};
    static constexpr glm::vec3 kTowardsSun{1.0f, 0.8f, 0.3f}; // not of unit length
    static constexpr glm::vec3 kFloor{0.5f, 0.45f, 0.4f};     // its albedo

    LitBox box;
    Scan scan; // a photo of it

    /// `sun` is the irradiance in the patch, from it and all else; the panel alone gives about 1.
    /// `paneRadiance` 0: there is none.
    explicit SunRoom(glm::vec3 sun, float paneRadiance = 0.0f, glm::vec3 towardsSun = kTowardsSun,
                     const Paint& paint = albedo);
    /// Its surfaces without a pane, with what a photo shows of them.
    [[nodiscard]] static Scan scanOf(const Paint& photo);

    [[nodiscard]] static Panel patchPanel(glm::vec3 towardsSun = kTowardsSun);
    [[nodiscard]] static Panel window();
    [[nodiscard]] static glm::vec3 albedo(glm::vec3 place, glm::vec3 normal);
};

} // namespace relamp::scenes
