#pragma once

#include "relamp/scan.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

/// How far an eye can back off from a place in a room before a wall is in its way.
class Reach
{
public:
    /// Distances, m, from a place to what faces it along unit directions; infinity where nothing
    /// does.
    using Look = std::function<std::vector<float>(glm::vec3, std::span<const glm::vec3>)>;

    /// `box` is the room's.
    Reach(Look look, const relamp::Bounds& box);

    /// To the first surface ahead, m.
    [[nodiscard]] float ahead(glm::vec3 from, glm::vec3 direction) const;

    /// How far from `place` along `direction` (unit) an eye may stand, m: a little before the wall.
    ///
    /// From one direction to the next it changes by no more than about kSlope m a radian, so an eye
    /// that goes around glides in before a wall, and out again. What is narrower than half a
    /// radian, as a chair or a thing that hangs in the air, is no wall.
    [[nodiscard]] float around(glm::vec3 place, glm::vec3 direction);

    /// Whether an eye is in the room that `place` is in, and not behind one of its walls.
    [[nodiscard]] bool sees(glm::vec3 place, glm::vec3 eye);

    static constexpr float kSlope = 2.0f; // m a radian

private:
    void lookAround(glm::vec3 place);

    Look look_;
    relamp::Bounds box_;
    std::optional<glm::vec3> place_; // that the rest belongs to
    std::vector<float> walls_;       // m, along directions that are spread evenly
    std::vector<float> reaches_;     // likewise; before walls, and falling to them by kSlope
};
