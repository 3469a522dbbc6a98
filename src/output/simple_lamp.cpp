#include "output/simple_lamp.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kMostPoints = 2000;   // that an outline is told from
constexpr float kStray = 0.01f;        // share of the points beyond either end that counts for none
constexpr float kBefore = 0.01f;       // m; of a light before the surface that it stands for
constexpr float kSmallestSide = 2e-3f; // m
constexpr float kBulb = 0.02f;         // m; smallest radius of a light that has none, as to gather
constexpr float kSmallFace = 0.1f;     // share of a lamp that has no light of its own
constexpr float kRound = 1.25f;        // longer over shorter side of what may be a disc
// Mean square distance from the middle over that of a corner of the box around: 1/4 of a disc, 1/3
// of a rectangle.
constexpr float kSpreadOfDisc = 0.29f;

/// The axes of a light that shines along `direction`; its height goes up as far as it can.
glm::mat3 facing(glm::vec3 direction)
{
    const glm::vec3 back = -glm::normalize(direction);
    const glm::vec3 up = std::abs(back.y) < 0.999f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

/// The axes turned around the third.
glm::mat3 turned(const glm::mat3& axes, float angle)
{
    const glm::vec3 right = std::cos(angle) * axes[0] + std::sin(angle) * axes[1];
    return {right, glm::cross(axes[2], right), axes[2]};
}

using Weight = std::function<float(const LampPoint&)>;

/// A surface as points of one area each.
struct EvenSurface
{
    std::vector<glm::vec3> points; // none where nothing weighs anything
    float area = 0.0f;             // m^2, of all of them
    float side = 0.0f;             // m, of the piece that a point of the scan stands for
};

EvenSurface evenSurface(const std::vector<LampPoint>& points, const Weight& weight)
{
    EvenSurface even;
    float pieces = 0.0f;
    for (const LampPoint& point : points) {
        even.area += weight(point);
        if (weight(point) > 0.0f) pieces += 1.0f;
    }
    if (even.area <= 0.0f) return even;
    even.side = std::sqrt(even.area / pieces);
    const size_t count = std::min(points.size(), kMostPoints);
    float upTo = 0.0f;
    for (const LampPoint& point : points) {
        upTo += weight(point);
        const float share = upTo / even.area * static_cast<float>(count);
        while (even.points.size() < count && static_cast<float>(even.points.size()) + 0.5f < share)
            even.points.push_back(point.position);
    }
    return even;
}

struct Range
{
    float low = 0.0f;
    float high = 0.0f;

    [[nodiscard]] float length() const { return (high - low) / (1.0f - 2.0f * kStray); }
    [[nodiscard]] float middle() const { return 0.5f * (low + high); }
};

/// Where points lie by a measure, but for strays.
Range rangeOf(const std::vector<glm::vec3>& points, const std::function<float(glm::vec3)>& measure)
{
    std::vector<float> values;
    for (const glm::vec3& point : points) values.push_back(measure(point));
    const auto stray = static_cast<size_t>(kStray * static_cast<float>(values.size()));
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(stray);
    const auto high = values.end() - 1 - static_cast<std::ptrdiff_t>(stray);
    std::nth_element(values.begin(), low, values.end());
    const float least = *low;
    std::nth_element(values.begin(), high, values.end());
    return {least, *high};
}

Range along(const std::vector<glm::vec3>& points, glm::vec3 axis)
{
    return rangeOf(points, [axis](glm::vec3 point) { return glm::dot(point, axis); });
}

/// The axes, turned so that the box around the points is smallest.
glm::mat3 alongOutline(const std::vector<glm::vec3>& points, const glm::mat3& axes)
{
    constexpr int kSteps = 45; // degrees to either side
    glm::mat3 best = axes;
    float least = along(points, axes[0]).length() * along(points, axes[1]).length();
    for (int step = -kSteps; step < kSteps; ++step) {
        const glm::mat3 other = turned(axes, glm::radians(static_cast<float>(step)));
        const float area = along(points, other[0]).length() * along(points, other[1]).length();
        if (area < 0.999f * least) {
            best = other;
            least = area;
        }
    }
    return best;
}

/// The radius of the disc that points fill; none where they fill their box.
std::optional<float> radiusOfDisc(const std::vector<glm::vec3>& points, const SimpleLamp& box)
{
    const float longer = std::max(box.width, box.height);
    if (longer > kRound * std::min(box.width, box.height)) return std::nullopt;
    float squares = 0.0f;
    for (const glm::vec3& point : points) {
        const glm::vec3 from = point - box.position;
        squares += std::pow(glm::dot(from, box.axes[0]), 2.0f) +
                   std::pow(glm::dot(from, box.axes[1]), 2.0f);
    }
    const float mean = squares / static_cast<float>(points.size());
    const float corner = 0.25f * (box.width * box.width + box.height * box.height);
    if (mean > kSpreadOfDisc * corner) return std::nullopt;
    return std::max(std::sqrt(2.0f * mean), 0.5f * kSmallestSide);
}

float areaOf(const LampPoint& point)
{
    return point.area;
}

/// Makes of `lamp`, which has axes, a flat light in the outline of what faces as it does, before
/// all of it. It is no smaller than that: a few texels in a row have no width but their own.
void standBefore(const std::vector<LampPoint>& points, SimpleLamp& lamp)
{
    const glm::vec3 normal = -lamp.axes[2];
    const EvenSurface all = evenSurface(points, areaOf);
    EvenSurface face = evenSurface(points, [normal](const LampPoint& point) {
        return point.area * std::max(glm::dot(point.normal, normal), 0.0f);
    });
    if (face.points.empty()) face = all;
    lamp.axes = alongOutline(face.points, lamp.axes);
    const Range x = along(face.points, lamp.axes[0]);
    const Range y = along(face.points, lamp.axes[1]);
    const float front = along(all.points, normal).high + kBefore;
    lamp.width = x.length() + face.side;
    lamp.height = y.length() + face.side;
    lamp.position = lamp.axes * glm::vec3(x.middle(), y.middle(), -front);
    lamp.shape = LampShape::rectangle;
    if (const auto radius = radiusOfDisc(face.points, lamp)) {
        lamp.shape = LampShape::disc;
        lamp.radius = *radius;
    }
    const float larger = std::sqrt(std::max(1.0f, face.area / lamp.area()));
    lamp.width *= larger;
    lamp.height *= larger;
    lamp.radius *= larger;
}

/// What of a surface faces along one of five directions: forward, and to each side.
using Faces = std::array<std::vector<LampPoint>, 5>;

std::array<glm::vec3, 5> directionsOf(const glm::mat3& axes)
{
    return {-axes[2], axes[0], -axes[0], axes[1], -axes[1]};
}

/// What faces back counts for the side that it faces most.
Faces facesOf(const std::vector<LampPoint>& points, const glm::mat3& axes)
{
    const std::array<glm::vec3, 5> directions = directionsOf(axes);
    Faces faces;
    for (const LampPoint& point : points) {
        size_t most = 0;
        for (size_t i = 1; i < faces.size(); ++i)
            if (glm::dot(point.normal, directions[i]) > glm::dot(point.normal, directions[most]))
                most = i;
        faces[most].push_back(point);
    }
    return faces;
}

float wholeAreaOf(const std::vector<LampPoint>& points)
{
    float area = 0.0f;
    for (const LampPoint& point : points) area += point.area;
    return area;
}

/// Lights before what faces forward and before each side that is no small part of the lamp; the
/// small ones' light is shared out among these. One light before all of a lamp that is about flat.
std::vector<SimpleLamp> flatLamps(const std::vector<LampPoint>& points, const SimpleLamp& whole)
{
    const glm::mat3 axes = alongOutline(evenSurface(points, areaOf).points, whole.axes);
    const Faces faces = facesOf(points, axes);
    const float all = wholeAreaOf(points);
    float split = 0.0f;
    for (const auto& face : faces)
        if (wholeAreaOf(face) >= kSmallFace * all) split += wholeAreaOf(face);
    std::vector<SimpleLamp> lamps;
    for (size_t i = 0; i < faces.size(); ++i) {
        if (wholeAreaOf(faces[i]) < kSmallFace * all) continue;
        SimpleLamp lamp = whole;
        const bool isAll = wholeAreaOf(faces[i]) == split;
        lamp.axes = i == 0 ? axes : facing(directionsOf(axes)[i]);
        lamp.emission *= wholeAreaOf(faces[i]) / split;
        standBefore(isAll ? points : faces[i], lamp);
        lamps.push_back(lamp);
    }
    return lamps;
}

/// A sphere around all of it.
void standAround(const std::vector<LampPoint>& points, SimpleLamp& lamp)
{
    const EvenSurface all = evenSurface(points, areaOf);
    const glm::vec3 middle = lamp.position;
    const Range reach =
        rangeOf(all.points, [middle](glm::vec3 point) { return glm::distance(point, middle); });
    lamp.radius = reach.high + kBefore;
}

} // namespace

float SimpleLamp::area() const
{
    if (shape == LampShape::rectangle) return width * height;
    return (shape == LampShape::disc ? 1.0f : 4.0f) * kPi * radius * radius;
}

std::vector<SimpleLamp> simpleLamps(const Fixture& fixture, const std::vector<LampPoint>& points)
{
    SimpleLamp lamp{
        .id = fixture.id, .position = fixture.centre, .emission = fixture.area * fixture.radiance};
    const bool isFlat = fixture.normal != glm::vec3(0.0f);
    if (isFlat) lamp.axes = facing(fixture.normal);
    lamp.shape = isFlat ? LampShape::disc : LampShape::sphere;
    lamp.radius = std::sqrt(fixture.area / ((isFlat ? 1.0f : 4.0f) * kPi));
    lamp.radius = std::max(lamp.radius, kSmallestSide);
    if (points.empty()) return {lamp};
    if (isFlat) return flatLamps(points, lamp);
    standAround(points, lamp);
    return {lamp};
}

SimpleLamp simpleLamp(const PointLight& point)
{
    return {.name = "light",
            .position = point.position,
            .radius = std::max(point.radius, kBulb),
            .emission = 4.0f * point.intensity}; // flux 4 pi I
}

SimpleLamp squareLamp(glm::vec3 centre, glm::vec3 normal, float area, glm::vec3 radiance)
{
    const float side = std::sqrt(area);
    return {.shape = LampShape::rectangle,
            .position = centre,
            .axes = facing(normal),
            .width = side,
            .height = side,
            .emission = area * radiance};
}

} // namespace relamp
