#include "output/viewpoints.h"

#include "base/parallel.h"
#include "output/camera_rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace relamp
{
namespace
{

constexpr int kPlaces = 9;      // along each side of the plan, at least
constexpr int kMostPlaces = 20; // of a house, whose rooms are a few metres long
constexpr float kStride = 1.0f; // m between places in between
constexpr int kMostLevels = 64; // above each other: storeys with what stands in them
constexpr int kYaws = 16;
constexpr float kPitch = -0.15f;     // radians; people look slightly down into a room
constexpr float kEyeHeight = 1.55f;  // m above the floor
constexpr float kMostHeight = 0.75f; // of what is free over a floor: eyes stay off a low ceiling
constexpr float kElbowRoom = 0.3f;   // m to the nearest thing
constexpr float kShown = 0.5f;       // what more of a room counts once a view shows some of it

struct ScoredView
{
    Camera camera;
    float score = 0.0f; // how much of the room's inside is seen, and from how far
};

/// Directions all around, evenly (Fibonacci sphere).
template<size_t N>
std::array<glm::vec3, N> sphereDirections()
{
    std::array<glm::vec3, N> directions;
    for (size_t i = 0; i < N; ++i) {
        const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / N;
        const float r = std::sqrt(1.0f - y * y);
        const float angle = 2.39996323f * static_cast<float>(i); // golden angle
        directions[i] = {r * std::cos(angle), y, r * std::sin(angle)};
    }
    return directions;
}

/// Share of all directions in which a surface is seen from its front; 0 where something is too
/// near, and where more backs are seen: between rooms, and in walls and furniture.
float insideness(const RayScene& scene, glm::vec3 place)
{
    static const auto directions = sphereDirections<96>();
    int fronts = 0;
    int backs = 0;
    for (const glm::vec3& direction : directions) {
        const Hit hit = scene.intersect({.origin = place, .direction = direction});
        if (hit.missed()) continue;
        if (hit.distance < kElbowRoom) return 0.0f;
        ++(hit.front ? fronts : backs);
    }
    return fronts > backs ? static_cast<float>(fronts) / static_cast<float>(directions.size())
                          : 0.0f;
}

/// Adds a place at eye height over whatever floors there are at one spot of the plan, of all
/// storeys; over the lowest height of the scan where there is none.
void addPlacesOver(glm::vec3 spot, const Bounds& house, const RayScene& scene,
                   std::vector<glm::vec3>& places)
{
    constexpr float kBehind = 1e-5f; // m, and of the way: past a surface
    float above = house.high.y;
    const auto stand = [&](float floor) {
        places.emplace_back(spot.x, floor + std::min(kEyeHeight, kMostHeight * (above - floor)),
                            spot.z);
    };
    Ray down{.origin = {spot.x, above, spot.z}, .direction = {0.0f, -1.0f, 0.0f}};
    const size_t before = places.size();
    for (int level = 0; level < kMostLevels; ++level) {
        const Hit hit = scene.intersect(down);
        if (hit.missed()) break;
        const float height = down.origin.y - hit.distance;
        if (hit.front) stand(height);
        above = height;
        down.nearest = hit.distance * (1.0f + kBehind) + kBehind;
    }
    if (places.size() == before) stand(house.low.y);
}

/// Places where one may stand, all over the plan.
std::vector<glm::vec3> candidatePlaces(const Scan& scan, const RayScene& scene)
{
    const Bounds house = boundsOf(scan);
    const auto along = [&](int axis) {
        const float strides = std::min(house.extent()[axis] / kStride, float{kMostPlaces});
        return std::max(static_cast<int>(strides), kPlaces);
    };
    const int across = along(0);
    const int deep = along(2);
    std::vector<glm::vec3> places;
    for (int z = 0; z < deep; ++z)
        for (int x = 0; x < across; ++x) {
            const glm::vec3 part((static_cast<float>(x) + 0.5f) / static_cast<float>(across), 0.0f,
                                 (static_cast<float>(z) + 0.5f) / static_cast<float>(deep));
            addPlacesOver(house.low + part * house.extent(), house, scene, places);
        }
    return places;
}

float scoreOf(const RayScene& scene, const Camera& camera, float depth)
{
    constexpr int kAcross = 16;
    constexpr int kDown = 10;
    float sum = 0.0f;
    RowOfRays row;
    const CameraRays rays(camera, {kAcross, kDown});
    for (int y = 0; y < kDown; ++y)
        lookAlong(y, 1, rays, scene, row, [&](size_t, const Ray&, const Hit& hit) {
            if (hit.missed() || !hit.front)
                sum -= 0.5f;
            else // far walls, but not only far walls
                sum += std::sqrt(std::min(hit.distance / depth, 1.0f));
        });
    return sum / (kAcross * kDown);
}

/// How much of what a view shows is left to show when there is the other one.
float leftToShow(const RayScene& scene, const Camera& view, const Camera& other)
{
    const glm::vec3 way = other.position - view.position;
    const float distance = glm::length(way);
    const float likeness = std::max(0.0f, glm::dot(view.forward, other.forward));
    const bool isOfOneRoom = distance == 0.0f || !scene.occluded({.origin = view.position,
                                                                  .direction = way / distance,
                                                                  .farthest = distance});
    return isOfOneRoom ? kShown * (1.0f - likeness) : 1.0f;
}

/// kYaws views from each of the places where one can stand; those from elsewhere score 0.
std::vector<ScoredView> viewsOf(const Scan& scan, const RayScene& scene)
{
    const Bounds room = boundsOf(scan);
    const std::vector<glm::vec3> places = candidatePlaces(scan, scene);
    const float depth =
        std::max(0.6f * glm::length(glm::vec2(room.extent().x, room.extent().z)), 0.1f);
    std::vector<ScoredView> views(places.size() * kYaws);
    forEach(places.size(), [&](size_t p) {
        const float inside = insideness(scene, places[p]);
        for (size_t yaw = 0; yaw < kYaws && inside > 0.0f; ++yaw) {
            const float angle = glm::two_pi<float>() * static_cast<float>(yaw) / kYaws;
            ScoredView& view = views[p * kYaws + yaw];
            view.camera.position = places[p];
            view.camera.forward = {std::cos(kPitch) * std::cos(angle), std::sin(kPitch),
                                   std::cos(kPitch) * std::sin(angle)};
            view.score = inside * std::max(scoreOf(scene, view.camera, depth), 1e-4f);
        }
    });
    return views;
}

bool scoresLess(const ScoredView& a, const ScoredView& b)
{
    return a.score < b.score;
}

/// Where there is no place inside: all of it, from outside.
Camera fromOutside(const Scan& scan)
{
    const Bounds room = boundsOf(scan);
    return {.position = room.centre() + glm::vec3(0.0f, 0.3f, 1.2f) * glm::length(room.extent()),
            .forward = glm::normalize(glm::vec3(0.0f, -0.25f, -1.0f))};
}

} // namespace

std::vector<Camera> chooseViewpoints(const Scan& scan, const RayScene& scene, int count)
{
    std::vector<ScoredView> views = viewsOf(scan, scene);
    std::vector<Camera> chosen;
    while (static_cast<int>(chosen.size()) < count) {
        const auto best = std::max_element(views.begin(), views.end(), scoresLess);
        if (best->score <= 0.0f) break;
        const Camera camera = best->camera;
        chosen.push_back(camera);
        forEach(views.size(), [&](size_t i) {
            if (views[i].score > 0.0f) views[i].score *= leftToShow(scene, views[i].camera, camera);
        });
    }
    if (chosen.empty()) chosen.push_back(fromOutside(scan));
    return chosen;
}

Camera chooseTurningPlace(const Scan& scan, const RayScene& scene)
{
    const std::vector<ScoredView> views = viewsOf(scan, scene);
    size_t best = 0;
    float bestSum = 0.0f;
    for (size_t place = 0; place < views.size(); place += kYaws) {
        float sum = 0.0f;
        for (size_t i = place; i < place + kYaws; ++i) sum += views[i].score;
        if (sum > bestSum) {
            bestSum = sum;
            best = place;
        }
    }
    if (bestSum == 0.0f) return fromOutside(scan);
    const auto begin = views.begin() + static_cast<ptrdiff_t>(best);
    return std::max_element(begin, begin + kYaws, scoresLess)->camera;
}

} // namespace relamp
