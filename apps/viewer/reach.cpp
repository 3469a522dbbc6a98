#include "reach.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace
{

constexpr int kDirections = 1024; // 0.11 rad apart
constexpr float kSpread = 0.11f;  // rad, over which reaches are averaged: about as far
constexpr float kNarrow = 0.25f;  // rad, half as wide as what is no wall
constexpr float kFarthestReach = 200.0f;
constexpr float kShare = 0.9f;  // of the way to a wall
constexpr float kSpace = 0.1f;  // m, to a wall
constexpr float kLeast = 0.03f; // m, from the place
constexpr float kSame = 1e-3f;  // m, between places that are one

/// A spiral from pole to pole.
const std::vector<glm::vec3>& directions()
{
    static const std::vector<glm::vec3> spiral = [] {
        const float golden = glm::pi<float>() * (3.0f - std::sqrt(5.0f));
        std::vector<glm::vec3> made;
        for (int i = 0; i < kDirections; ++i) {
            const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / kDirections;
            const float r = std::sqrt(1.0f - y * y);
            const float angle = golden * static_cast<float>(i);
            made.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
        }
        return made;
    }();
    return spiral;
}

/// The chord between unit directions, which is their angle where that is small.
float between(glm::vec3 a, glm::vec3 b)
{
    const glm::vec3 way = a - b;
    return std::sqrt(glm::dot(way, way));
}

/// Of every direction, what `better` keeps of those within kNarrow.
template<class Better>
std::vector<float> bestNearby(const std::vector<float>& values, const Better& better)
{
    const std::vector<glm::vec3>& all = directions();
    const float cosine = std::cos(kNarrow);
    std::vector<float> best = values;
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t j = 0; j < all.size(); ++j)
            if (glm::dot(all[i], all[j]) > cosine) best[i] = better(best[i], values[j]);
    return best;
}

/// The largest that nowhere exceeds `limits` and has no slope above kSlope.
std::vector<float> lowered(const std::vector<float>& limits)
{
    const std::vector<glm::vec3>& all = directions();
    std::vector<float> low = limits;
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t j = 0; j < all.size(); ++j)
            low[i] = std::min(low[i], limits[j] + Reach::kSlope * between(all[i], all[j]));
    return low;
}

} // namespace

Reach::Reach(Look look, const relamp::Bounds& box) : look_(std::move(look)), box_(box) {}

float Reach::ahead(glm::vec3 from, glm::vec3 direction) const
{
    return look_(from, std::span(&direction, 1)).front();
}

void Reach::lookAround(glm::vec3 place)
{
    if (place_ && glm::distance(*place_, place) < kSame) return;
    place_ = place;
    std::vector<float> seen = look_(place, directions());
    for (float& distance : seen) distance = std::min(distance, kFarthestReach);
    const auto larger = [](float a, float b) { return std::max(a, b); };
    const auto smaller = [](float a, float b) { return std::min(a, b); };
    walls_ = bestNearby(bestNearby(seen, larger), smaller);
    std::vector<float> limits = walls_;
    for (float& limit : limits) limit = std::max(std::min(kShare * limit, limit - kSpace), kLeast);
    reaches_ = lowered(limits);
}

float Reach::around(glm::vec3 place, glm::vec3 direction)
{
    lookAround(place);
    float sum = 0.0f;
    float weights = 0.0f;
    for (size_t i = 0; i < reaches_.size(); ++i) {
        const float away = between(directions()[i], direction) / kSpread;
        const float weight = std::exp(-away * away);
        weights += weight;
        sum += weight * reaches_[i];
    }
    return sum / weights;
}

bool Reach::sees(glm::vec3 place, glm::vec3 eye)
{
    const float distance = glm::distance(place, eye);
    if (!box_.contains(eye)) return false;
    if (distance < kLeast) return true;
    const glm::vec3 direction = (eye - place) / distance;
    if (ahead(place, direction) > distance) return true;
    lookAround(place);
    const std::vector<glm::vec3>& all = directions();
    const auto nearest = std::max_element(all.begin(), all.end(), [&](glm::vec3 a, glm::vec3 b) {
        return glm::dot(a, direction) < glm::dot(b, direction);
    });
    return walls_[static_cast<size_t>(nearest - all.begin())] > distance;
}
