#include "fit/pairs.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/white_balance.h"
#include "lights/candidates.h"
#include "scan/one_room.h"

#include <algorithm>
#include <array>
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
constexpr size_t kPairsForRooms = 1000; // to tell how many rooms there are
constexpr double kFewestInRoom = 10.0;  // of these, to tell anything; else as many again
constexpr int kDrawingsForRooms = 32;   // at most
constexpr int kTriesOfWall = 64;        // to find an upright place on another plane
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

bool isWithinError(float offPlane)
{
    return std::abs(offPlane) <= 2.5f * kScanError;
}

bool areOnOnePlane(glm::vec3 p, glm::vec3 normalOfP, glm::vec3 q, glm::vec3 normalOfQ)
{
    return glm::dot(normalOfP, normalOfQ) >= kSamePlane &&
           isWithinError(glm::dot(q - p, normalOfP));
}

bool couldBeOneMaterial(const PairPlace& p, const PairPlace& q)
{
    return !p.isDark && !q.isDark && areOnOnePlane(p.position, p.normal, q.position, q.normal) &&
           glm::distance(p.chroma, q.chroma) < kSameColor;
}

/// Numbers of the places of each room.
std::vector<std::vector<uint32_t>> placesOfRooms(size_t count, std::span<const uint8_t> rooms)
{
    std::vector<std::vector<uint32_t>> ofRooms(1);
    for (uint32_t p = 0; p < count; ++p) {
        const size_t room = rooms.empty() ? 0 : rooms[p];
        if (room >= ofRooms.size()) ofRooms.resize(room + 1);
        ofRooms[room].push_back(p);
    }
    return ofRooms;
}

/// At most as many pairs of each place as are wanted, with places that may be in its room.
std::vector<MaterialPair> drawOnPlanes(std::span<const PairPlace> places,
                                       std::span<const uint8_t> rooms,
                                       std::span<const size_t> wanted, std::mt19937& random)
{
    std::vector<MaterialPair> pairs;
    const std::vector<std::vector<uint32_t>> ofRooms = placesOfRooms(places.size(), rooms);
    for (uint32_t p = 0; p < places.size(); ++p) {
        const std::vector<uint32_t>& others = ofRooms[rooms.empty() ? 0 : rooms[p]];
        size_t found = 0;
        for (size_t attempt = 0; attempt < 32 * wanted[p] && found < wanted[p]; ++attempt) {
            const uint32_t q = others[static_cast<uint32_t>(random()) % others.size()];
            if (q == p || !couldBeOneMaterial(places[p], places[q])) continue;
            pairs.push_back({p, q});
            ++found;
        }
    }
    return pairs;
}

/// Which pairs are in one room. `placeOf`: the FacingPlace of a place.
template<class PlaceOf>
std::vector<uint8_t> markedInRoom(std::span<const MaterialPair> pairs, const RayScene& scene,
                                  const PlaceOf& placeOf)
{
    std::vector<uint8_t> isInRoom(pairs.size());
    forEach(pairs.size(), [&](size_t k) {
        isInRoom[k] = areInOneRoomOfPlane(scene, placeOf(pairs[k].p), placeOf(pairs[k].q)) ? 1 : 0;
    });
    return isInRoom;
}

bool isFloor(const Surfels& surfels, uint32_t surfel)
{
    return surfels.normal[surfel].y > 0.0f;
}

/// Pairs of `level` surfels of one height, by heights: normals are off by too much for planes as
/// long as a house.
std::vector<MaterialPair> drawLevel(const Surfels& surfels, std::span<const uint32_t> level,
                                    std::mt19937& random)
{
    std::vector<MaterialPair> drawn;
    const auto height = [&](uint32_t s) { return surfels.position[s].y; };
    for (size_t attempt = 0; attempt < kPairsForRooms * 32 && drawn.size() < kPairsForRooms;
         ++attempt) {
        const uint32_t p = level[random() % level.size()];
        const uint32_t q = level[random() % level.size()];
        if (p != q && isFloor(surfels, p) == isFloor(surfels, q) &&
            isWithinError(height(p) - height(q)))
            drawn.push_back({p, q});
    }
    return drawn;
}

/// As much as a plane is one.
bool isUpright(const Surfels& surfels, uint32_t surfel)
{
    return std::abs(surfels.normal[surfel].y) <= std::sqrt(1.0f - kSamePlane * kSamePlane);
}

/// Of two places in one light; where their hues differ by more than automatic white balance does to
/// them it is two.
bool isOnePaint(glm::vec3 albedoOfP, glm::vec3 albedoOfQ)
{
    const glm::vec3 step = glm::log(albedoOfP) - glm::log(albedoOfQ);
    return std::hypot(step.r - step.g, step.b - step.g) < static_cast<float>(kTintSpread) &&
           std::abs(std::log(luminance(albedoOfP) / luminance(albedoOfQ))) < kPaintStep;
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

double roomsOf(const Surfels& surfels, const RayScene& scene)
{
    std::vector<uint32_t> level;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (std::abs(surfels.normal[s].y) >= kSamePlane) level.push_back(s);
    if (level.empty()) return 1.0;
    std::mt19937 random(surfels.seed);
    std::array<double, 2> all{}; // of ceilings and of floors
    std::array<double, 2> inRoom{};
    for (int drawing = 0; drawing < kDrawingsForRooms; ++drawing) {
        const std::vector<MaterialPair> drawn = drawLevel(surfels, level, random);
        const auto isInRoom = markedInRoom(drawn, scene, [&](uint32_t s) {
            return FacingPlace{surfels.position[s], surfels.normal[s]};
        });
        for (size_t k = 0; k < drawn.size(); ++k) {
            const size_t which = isFloor(surfels, drawn[k].p) ? 1 : 0;
            all[which] += 1.0;
            inRoom[which] += isInRoom[k] != 0 ? 1.0 : 0.0;
        }
        if (std::ranges::max(inRoom) >= kFewestInRoom) break;
    }
    double rooms = 1.0;
    for (size_t which = 0; which < all.size(); ++which)
        if (inRoom[which] >= kFewestInRoom) rooms = std::max(rooms, all[which] / inRoom[which]);
    return rooms;
}

std::vector<MaterialPair> drawPairs(std::span<const glm::vec3> shown,
                                    std::span<const uint32_t> surfels, const Surfels& all,
                                    const RayScene& scene, size_t perPlace,
                                    std::span<const uint8_t> rooms)
{
    std::vector<MaterialPair> result;
    const std::vector<PairPlace> places = placesOf(shown, surfels, all);
    if (places.size() < 2) return result;
    std::mt19937 random(
        all.seed); // its raw numbers are the same everywhere; distributions need not be
    std::vector<size_t> wanted(places.size(), perPlace);
    for (int round = 0; round < kDrawings; ++round) {
        const std::vector<MaterialPair> drawn = drawOnPlanes(places, rooms, wanted, random);
        const auto isInRoom = markedInRoom(drawn, scene, [&](uint32_t p) {
            return FacingPlace{places[p].position, places[p].normal};
        });
        std::fill(wanted.begin(), wanted.end(), size_t{0});
        for (size_t k = 0; k < drawn.size(); ++k)
            if (isInRoom[k] != 0)
                result.push_back(drawn[k]);
            else
                ++wanted[drawn[k].p];
    }
    return result;
}

std::vector<MaterialPair> drawAcrossWalls(std::span<const glm::vec3> albedo,
                                          std::span<const uint32_t> surfels, const Surfels& all,
                                          size_t perPlace, std::span<const uint8_t> rooms)
{
    std::vector<MaterialPair> pairs;
    std::mt19937 random(all.seed);
    const std::vector<std::vector<uint32_t>> ofRooms = placesOfRooms(surfels.size(), rooms);
    for (uint32_t p = 0; p < surfels.size(); ++p) {
        if (!isUpright(all, surfels[p])) continue;
        const std::vector<uint32_t>& others = ofRooms[rooms.empty() ? 0 : rooms[p]];
        size_t looked = 0;
        for (int attempt = 0; attempt < kTriesOfWall && looked < perPlace; ++attempt) {
            const uint32_t q = others[static_cast<uint32_t>(random()) % others.size()];
            if (!isUpright(all, surfels[q]) || areOnOnePlane(all, surfels[p], surfels[q])) continue;
            ++looked;
            if (isOnePaint(albedo[p], albedo[q])) pairs.push_back({p, q});
        }
    }
    return pairs;
}

} // namespace relamp
