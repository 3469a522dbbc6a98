#include "rooms/builder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relamp::rooms
{

Frame Frame::moved(glm::vec3 by, float angle) const
{
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return {at(by), c * x - s * z, y, s * x + c * z};
}

int Builder::add(const Paint& paint)
{
    room.paints.push_back(paint);
    return static_cast<int>(room.paints.size()) - 1;
}

glm::vec3 Builder::anyColour(float value, float saturation)
{
    const glm::vec3 colour(random_.next(), random_.next(), random_.next());
    const float most = std::max({colour.r, colour.g, colour.b, 0.1f});
    return value * (1.0f - saturation + saturation * colour / most);
}

int Builder::anyPaint(float value)
{
    constexpr std::array kPatterns{Paint::plain, Paint::plain,  Paint::planks,
                                   Paint::cloth, Paint::checks, Paint::stripes};
    const float saturation = between(0.1f, 0.8f);
    Paint paint{.pattern = kPatterns[static_cast<size_t>(anyOf(kPatterns.size()))],
                .first = anyColour(value * between(0.7f, 1.3f), saturation),
                .size = between(0.08f, 0.25f),
                .seed = static_cast<uint64_t>(anyOf(1 << 20))};
    paint.second = between(0.4f, 0.8f) * paint.first;
    return add(paint);
}

int Builder::addLamp(const std::string& kind, glm::vec3 radiance)
{
    room.lamps.push_back({kind, radiance});
    return static_cast<int>(room.lamps.size()) - 1;
}

void Builder::panel(const Frame& frame, glm::vec3 corner, glm::vec3 alongU, glm::vec3 alongV,
                    int paint, int lamp)
{
    room.patches.push_back({.corner = frame.at(corner),
                            .alongU = frame.turned(alongU),
                            .alongV = frame.turned(alongV),
                            .paint = paint,
                            .lamp = lamp});
}

void Builder::box(const Frame& frame, glm::vec3 low, glm::vec3 high, int paint, Faces faces,
                  int lamp)
{
    const glm::vec3 x(high.x - low.x, 0, 0);
    const glm::vec3 y(0, high.y - low.y, 0);
    const glm::vec3 z(0, 0, high.z - low.z);
    panel(frame, {high.x, low.y, high.z}, -z, y, paint, lamp);
    panel(frame, low, z, y, paint, lamp);
    panel(frame, {low.x, low.y, high.z}, x, y, paint, lamp);
    if (faces != allButBack) panel(frame, {high.x, low.y, low.z}, -x, y, paint, lamp);
    if (faces != allButTop) panel(frame, {low.x, high.y, high.z}, x, -z, paint, lamp);
    if (faces != allButBottom) panel(frame, low, x, z, paint, lamp);
}

void Builder::sphere(glm::vec3 centre, float radius, int paint, int lamp)
{
    const size_t first = room.patches.size();
    box({.origin = centre}, glm::vec3(-radius), glm::vec3(radius), paint, allFaces, lamp);
    for (size_t i = first; i < room.patches.size(); ++i) {
        room.patches[i].radius = radius;
        room.patches[i].centre = centre;
    }
}

} // namespace relamp::rooms
