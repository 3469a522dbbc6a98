#include "fit/pairs.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "lights/candidates.h"
#include "scan/one_room.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace relamp
{
namespace
{

constexpr float kSameColor =
    0.6f; // length of the step in log r, g, b after brightness is taken out
constexpr float kDarkestPaired = 0.004f; // luminance; below, a byte's steps are too coarse

// Numerics.
constexpr int kDrawings = 8; // of drawing for what lay in other rooms, as in a house of several

/// Colour without brightness, in logs.
glm::vec3 chromaOf(glm::vec3 radiance)
{
    return glm::log(glm::max(radiance, glm::vec3(kFaintest)) / luminance(radiance));
}

/// What tells whether two places are of one material.
struct PairPlace
{
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 chroma;
    bool isDark;
};

std::vector<PairPlace> placesOf(std::span<const glm::vec3> shown, std::span<const uint32_t> surfels,
                                const Surfels& all)
{
    std::vector<PairPlace> places;
    for (size_t i = 0; i < shown.size(); ++i)
        places.push_back({all.position[surfels[i]], all.normal[surfels[i]], chromaOf(shown[i]),
                          luminance(shown[i]) < kDarkestPaired});
    return places;
}

bool areOnOnePlane(glm::vec3 p, glm::vec3 normalOfP, glm::vec3 q, glm::vec3 normalOfQ)
{
    return glm::dot(normalOfP, normalOfQ) >= kSamePlane &&
           std::abs(glm::dot(q - p, normalOfP)) <= 2.5f * kScanError;
}

bool couldBeOneMaterial(const PairPlace& p, const PairPlace& q)
{
    return !p.isDark && !q.isDark && areOnOnePlane(p.position, p.normal, q.position, q.normal) &&
           glm::distance(p.chroma, q.chroma) < kSameColor;
}

/// At most as many pairs of each place as are wanted, of any rooms.
std::vector<MaterialPair> drawOnPlanes(std::span<const PairPlace> places,
                                       std::span<const size_t> wanted, std::mt19937& random)
{
    std::vector<MaterialPair> pairs;
    const auto count = static_cast<uint32_t>(places.size());
    for (uint32_t p = 0; p < count; ++p) {
        size_t found = 0;
        for (size_t attempt = 0; attempt < 32 * wanted[p] && found < wanted[p]; ++attempt) {
            const uint32_t q = static_cast<uint32_t>(random()) % count;
            if (q == p || !couldBeOneMaterial(places[p], places[q])) continue;
            pairs.push_back({p, q});
            ++found;
        }
    }
    return pairs;
}

std::vector<uint8_t> markedInRoom(std::span<const PairPlace> places,
                                  std::span<const MaterialPair> pairs, const RayScene& scene)
{
    std::vector<uint8_t> isInRoom(pairs.size());
    forEach(pairs.size(), [&](size_t k) {
        const PairPlace& p = places[pairs[k].p];
        const PairPlace& q = places[pairs[k].q];
        isInRoom[k] =
            areInOneRoomOfPlane(scene, {p.position, p.normal}, {q.position, q.normal}) ? 1 : 0;
    });
    return isInRoom;
}

/// Of pairs drawn at random. All of a storey is on the planes of its floors and ceilings; a wall's
/// is mostly that of one room.
double roomsBy(std::span<const PairPlace> places, std::span<const MaterialPair> pairs,
               std::span<const uint8_t> isInRoom)
{
    size_t all = 0;
    size_t inRoom = 0;
    for (size_t k = 0; k < pairs.size(); ++k) {
        if (std::abs(places[pairs[k].p].normal.y) < kSamePlane) continue;
        ++all;
        inRoom += isInRoom[k];
    }
    return inRoom > 0 ? static_cast<double>(all) / static_cast<double>(inRoom) : 1.0;
}

} // namespace

bool areOnOnePlane(const Surfels& surfels, uint32_t p, uint32_t q)
{
    return areOnOnePlane(surfels.position[p], surfels.normal[p], surfels.position[q],
                         surfels.normal[q]);
}

bool haveOneColor(glm::vec3 shownP, glm::vec3 shownQ)
{
    return std::min(luminance(shownP), luminance(shownQ)) >= kDarkestPaired &&
           glm::distance(chromaOf(shownP), chromaOf(shownQ)) < kSameColor;
}

DrawnPairs drawPairs(std::span<const glm::vec3> shown, std::span<const uint32_t> surfels,
                     const Surfels& all, const RayScene& scene, size_t perPlace)
{
    DrawnPairs result;
    const std::vector<PairPlace> places = placesOf(shown, surfels, all);
    if (places.size() < 2) return result;
    std::mt19937 random(
        all.seed); // its raw numbers are the same everywhere; distributions need not be
    std::vector<size_t> wanted(places.size(), perPlace);
    for (int round = 0; round < kDrawings; ++round) {
        const std::vector<MaterialPair> drawn = drawOnPlanes(places, wanted, random);
        const std::vector<uint8_t> isInRoom = markedInRoom(places, drawn, scene);
        if (round == 0) result.rooms = roomsBy(places, drawn, isInRoom);
        std::fill(wanted.begin(), wanted.end(), size_t{0});
        for (size_t k = 0; k < drawn.size(); ++k)
            if (isInRoom[k] != 0)
                result.pairs.push_back(drawn[k]);
            else
                ++wanted[drawn[k].p];
    }
    return result;
}

} // namespace relamp
