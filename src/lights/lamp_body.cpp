#include "lights/lamp_body.h"

#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

constexpr float kFlattest = 0.85f;   // length of the mean normal; a half cylinder has 0.64
constexpr float kWhole = 0.15f;      // below, all sides were seen
constexpr int kPatches = 32;         // of a ball or disc; they share its area evenly
constexpr size_t kFewest = 4;        // patches that tell a shape
constexpr float kFacingAlike = 0.7f; // cosine
constexpr float kTowardsMean =
    0.05f;                        // of the curvature's middle: along an axis nothing else holds it
constexpr float kOffBody = 0.03f; // m off the body before a ray looks for the room
constexpr size_t kLooks = 8;      // rays of a patch
constexpr size_t kSeesRoom = 5;   // of these

/// The point that the lines along all normals pass nearest.
glm::vec3 middleOf(const Candidate& candidate)
{
    glm::mat3 normalSum(0.0f);
    glm::vec3 positionSum(0.0f);
    for (const ClippedPatch& patch : candidate.patches) {
        const glm::mat3 across =
            glm::mat3(1.0f + kTowardsMean) - glm::outerProduct(patch.normal, patch.normal);
        normalSum += patch.area * across;
        positionSum += patch.area * (across * (patch.position - candidate.centre));
    }
    return candidate.centre + glm::inverse(normalSum) * positionSum;
}

bool isScanned(const Surfels& surfels, glm::vec3 place, glm::vec3 normal)
{
    bool scanned = false;
    surfels.forEachInReach(place, [&](size_t s) {
        scanned |= glm::distance(surfels.position[s], place) < kScanError + 0.5f * surfels.size &&
                   glm::dot(surfels.normal[s], normal) > kFacingAlike;
    });
    return scanned;
}

/// Whether most of what it would light is there: the fronts of surfaces.
bool facesRoom(const RayScene& scene, const ClippedPatch& patch)
{
    size_t fronts = 0;
    for (size_t k = 0; k < kLooks; ++k) {
        const glm::vec2 u = evenPoint(static_cast<float>(k), glm::vec2(0.5f));
        const Hit hit = scene.intersect({.origin = patch.position + kOffBody * patch.normal,
                                         .direction = cosineDirection(patch.normal, u)});
        fronts += !hit.missed() && hit.front ? 1u : 0u;
    }
    return fronts >= kSeesRoom;
}

} // namespace

std::vector<ClippedPatch> patchedBall(glm::vec3 centre, float radius)
{
    const float area = 4.0f * kPi * radius * radius / kPatches;
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 way = evenDirection(evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        patches.push_back({centre + radius * way, way, area, Surfels::kNone});
    }
    return patches;
}

std::vector<ClippedPatch> patchedDisc(glm::vec3 centre, glm::vec3 normal, float radius)
{
    const float area = kPi * radius * radius / kPatches;
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kPatches; ++i) {
        const glm::vec3 over =
            cosineDirection(normal, evenPoint(static_cast<float>(i), glm::vec2(0.5f)));
        const glm::vec3 onDisc = over - glm::dot(over, normal) * normal;
        patches.push_back({centre + radius * onDisc, normal, area, Surfels::kNone});
    }
    return patches;
}

Candidate unseenSideOf(const Candidate& candidate, const Texels& texels, const RayScene& scene)
{
    const float flatness = glm::length(candidate.normal);
    if (candidate.patches.size() < kFewest || flatness > kFlattest || flatness < kWhole) return {};
    const glm::vec3 seen = candidate.normal / flatness;
    const glm::vec3 middle = middleOf(candidate);
    std::vector<ClippedPatch> unseen;
    for (const ClippedPatch& patch : candidate.patches) {
        const float before = glm::dot(patch.position - middle, seen);
        ClippedPatch mirrored{patch.position - 2.0f * before * seen,
                              patch.normal - 2.0f * glm::dot(patch.normal, seen) * seen, patch.area,
                              Surfels::kNone};
        if (before <= 0.0f || isScanned(texels.surfels, mirrored.position, mirrored.normal) ||
            !facesRoom(scene, mirrored))
            continue;
        unseen.push_back(mirrored);
    }
    return candidateOf(std::move(unseen));
}

} // namespace relamp
