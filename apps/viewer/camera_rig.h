#pragma once

#include "reach.h"

#include "relamp/camera.h"
#include "relamp/scan.h"

#include <memory>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

/// A half-line in the world.
struct Sight
{
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f}; // unit
};

/// The camera that a person moves: around a place, or through the room.
///
/// An orbit that begins in the room stays there: the eye comes nearer to its place where a wall
/// would be in the way, and backs off again behind it. `frame` leaves the room, `approach` leads
/// back into it.
///
/// It never rolls. Angles are rad; screens count from their upper left corner, 0..1 each way.
class CameraRig
{
public:
    enum class Mode { orbit, walk };
    Mode mode = Mode::orbit;

    /// The room that it keeps inside; none: nothing is in its way.
    void setRoom(std::shared_ptr<Reach> room);

    /// `distance` is how far away the place lies that it is turned around, m.
    void set(const relamp::Camera& camera, float distance);
    /// Backs off along its direction until the box is seen as a whole, through walls if it must.
    void frame(const relamp::Bounds& box, float aspect);
    /// Comes nearer to what it turns around until no wall is between.
    void comeInside();
    /// Makes `place` what it turns around, and looks there.
    void lookAt(glm::vec3 place);

    /// Right and up; in mode orbit around the place, in mode walk where it stands.
    void turn(glm::vec2 by);
    /// Shifts camera and place alongside the screen, `by` in heights of the screen.
    void pan(glm::vec2 by);
    /// `steps` of 10 % nearer to the place; in mode walk, forward.
    void approach(float steps);
    /// Right, up and forward, m; level whatever the pitch.
    void walk(glm::vec3 by);

    [[nodiscard]] relamp::Camera camera() const;
    [[nodiscard]] glm::vec3 position() const { return position_; }
    [[nodiscard]] glm::vec3 forward() const;
    [[nodiscard]] glm::vec3 right() const;
    [[nodiscard]] glm::vec3 place() const { return position_ + distance_ * forward(); }

    /// Vulkan's clip space of a screen that is `aspect` times as wide as high.
    [[nodiscard]] glm::mat4 clipFromWorld(float aspect) const;
    [[nodiscard]] Sight sightThrough(glm::vec2 screen, float aspect) const;
    /// Where a point appears; z is its distance along the view, m, not above 0 if it is behind.
    [[nodiscard]] glm::vec3 onScreen(glm::vec3 point, float aspect) const;
    /// The place whose depth in the picture is `depth`, 0..1.
    [[nodiscard]] glm::vec3 pointAt(glm::vec2 screen, float depth, float aspect) const;

    bool operator==(const CameraRig&) const = default;

private:
    [[nodiscard]] float heightAngle(float aspect) const;
    void findPlace();
    [[nodiscard]] float limit() const;
    void shift(glm::vec3 by);

    glm::vec3 position_{0.0f};
    float yaw_ = 0.0f; // from -z to +x
    float pitch_ = 0.0f;
    float distance_ = 2.0f; // of the eye to the place, m
    float wanted_ = 2.0f;   // the same where no wall is in the way
    float angle_ = 1.2f;    // field of view
    relamp::Across across_ = relamp::Across::width;
    std::shared_ptr<Reach> room_;
    bool knowsPlace_ = false; // it lies in the room, as far as one is there
    bool isInside_ = false;   // the eye is to stay in the room
};
