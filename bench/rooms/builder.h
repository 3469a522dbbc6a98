#pragma once

#include "base/random.h"
#include "rooms/room.h"

#include <string>

namespace relamp::rooms
{

/// Where a thing stands: x to the right along it, y up, z towards who stands before it.
struct Frame
{
    glm::vec3 origin{0.0f}; // world, m
    glm::vec3 x{1, 0, 0};
    glm::vec3 y{0, 1, 0};
    glm::vec3 z{0, 0, 1};

    [[nodiscard]] glm::vec3 at(glm::vec3 p) const { return origin + turned(p); }
    [[nodiscard]] glm::vec3 turned(glm::vec3 v) const { return v.x * x + v.y * y + v.z * z; }
    /// The same, moved by `by` of its own and turned about its vertical, radians.
    [[nodiscard]] Frame moved(glm::vec3 by, float angle = 0.0f) const;
};

enum Faces { allFaces, allButBottom, allButTop, allButBack };

/// Puts a room together out of panels, boxes and spheres.
class Builder
{
public:
    explicit Builder(uint64_t seed) : random_(seed, 0, 0) {}

    Room room;

    float between(float low, float high) { return low + (high - low) * random_.next(); }
    int anyOf(int count) { return static_cast<int>(random_.next() * static_cast<float>(count)); }

    int add(const Paint& paint);
    /// A paint of any colour and pattern; `value` is its albedo, about.
    int anyPaint(float value);
    glm::vec3 anyColour(float value, float saturation);
    int addLamp(const std::string& kind, glm::vec3 radiance);

    void panel(const Frame& frame, glm::vec3 corner, glm::vec3 alongU, glm::vec3 alongV, int paint,
               int lamp = -1);
    void box(const Frame& frame, glm::vec3 low, glm::vec3 high, int paint,
             Faces faces = allButBottom, int lamp = -1);
    void sphere(glm::vec3 centre, float radius, int paint, int lamp);

private:
    Random random_;
};

} // namespace relamp::rooms
