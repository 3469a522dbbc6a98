#pragma once

#include "camera_rig.h"

#include <optional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// Where on the line through `origin` along `axis` (unit) the sight comes nearest, m from `origin`;
/// nothing where they run alongside each other.
std::optional<float> nearestAlong(const Sight& sight, glm::vec3 origin, glm::vec3 axis);

/// Where the sight meets the plane through `point`; nothing where it runs alongside it or away.
std::optional<glm::vec3> meetsPlane(const Sight& sight, glm::vec3 point, glm::vec3 normal);

/// What of the gizmo can be taken hold of.
enum class Handle { none, x, y, z, centre, aim };

/// A light as the gizmo sees it.
struct Aimed
{
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; // unit
    bool aims = false;                      // its direction matters

    bool operator==(const Aimed&) const = default;
};

/// Moves and turns a light: three arrows along the axes, a middle that follows the mouse alongside
/// the screen, and the tip of the light's direction, which turns it.
class Gizmo
{
public:
    /// A screen of this shape and this camera, for as long as a frame.
    struct Eye
    {
        const CameraRig& rig;
        glm::vec2 pixels{1.0f}; // of the screen
    };

    /// How long its arrows are so that they look the same from everywhere, m.
    [[nodiscard]] static float armOf(const Aimed& light, const Eye& eye);
    /// Where a handle is drawn, in the world.
    [[nodiscard]] static glm::vec3 tipOf(Handle handle, const Aimed& light, const Eye& eye);
    /// The handle under a pixel, of those that the light has.
    [[nodiscard]] static Handle under(glm::vec2 pixel, const Aimed& light, const Eye& eye);

    /// Takes hold; `pixel` is where the mouse is.
    void grab(Handle handle, glm::vec2 pixel, const Aimed& light, const Eye& eye);
    /// The light as it is with the mouse at `pixel`. Only between `grab` and `release`.
    [[nodiscard]] Aimed dragged(glm::vec2 pixel, const Eye& eye) const;
    void release() { held_ = Handle::none; }
    [[nodiscard]] Handle held() const { return held_; }

private:
    [[nodiscard]] std::optional<glm::vec3> grip(glm::vec2 pixel, const Eye& eye) const;

    Handle held_ = Handle::none;
    Aimed start_;
    glm::vec3 plane_{0.0f};  // through it moves what follows the mouse
    glm::vec3 offset_{0.0f}; // from the grip to what is moved
};
