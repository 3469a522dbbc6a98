#pragma once

#include "relamp/scan.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

constexpr float kOffSurface =
    2e-3f; // m, where rays start; less than things that lie on each other are apart

struct Ray
{
    glm::vec3 origin{0.0f};    // finite
    glm::vec3 direction{0.0f}; // unit
    float nearest = 0.0f;      // metres; surfaces closer than this are passed
    float farthest = 1e30f;
};

struct Hit
{
    static constexpr uint32_t kNothing = ~0u;

    uint32_t triangle = kNothing; // in the order of the scan's meshes: index of its facet
    float distance = 0.0f;        // metres
    glm::vec2 weights{0.0f};      // of the triangle's second and third corner
    bool front = false;           // whether the ray met the side that the triangle faces

    [[nodiscard]] bool missed() const { return triangle == kNothing; }
};

/// How rays next to each other go: nearly the same way, as those of a picture, or all ways.
enum class RayOrder : uint8_t { coherent, scattered };

/// The scan's surface as something that rays can meet. Thread safe once built; copies share it.
class RayScene
{
public:
    explicit RayScene(const Scan& scan);

    /// The same surface, of which rays pass the triangles that `isOpen` is not 0 for, one a
    /// triangle. Both share the tree.
    [[nodiscard]] RayScene without(std::vector<uint8_t> isOpen) const;

    /// First surface that each ray meets; hits[i] belongs to rays[i]. Many rays at once cost less
    /// than one by one, and least where neighbouring rays go as `order` says.
    void intersect(std::span<const Ray> rays, std::span<Hit> hits, RayOrder order) const;
    [[nodiscard]] Hit intersect(const Ray& ray) const;

    /// Whether anything lies between `nearest` and `farthest` on each ray: blocked[i] is not 0.
    void occluded(std::span<const Ray> rays, std::span<uint8_t> blocked) const;
    [[nodiscard]] bool occluded(const Ray& ray) const;

    /// The box around all surfaces.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

private:
    struct Embree;
    struct Query;

    std::shared_ptr<const Embree> embree_;
    std::shared_ptr<const std::vector<uint8_t>> isOpen_; // null: rays pass none
    Bounds bounds_;
};

} // namespace relamp
