#include "rooms/paint.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace relamp::rooms
{
namespace
{

constexpr float kGrout = 0.06f; // of a tile's side
constexpr float kGap = 0.04f;   // of a plank's width

float randomAt(int x, int y, int z, uint64_t seed)
{
    const auto word = [](int i) { return static_cast<uint64_t>(static_cast<uint32_t>(i)); };
    return Random(seed, word(x) << 32 | word(y), word(z)).next();
}

/// Coordinates along a surface in metres: the same on all pieces of one wall.
glm::vec2 alongSurface(glm::vec3 p, glm::vec3 n)
{
    const glm::vec3 a = glm::abs(n);
    if (a.y >= a.x && a.y >= a.z) return {p.x, p.z};
    if (a.x >= a.z) return {p.z, p.y};
    return {p.x, p.y};
}

glm::vec3 plankAlbedo(const Paint& paint, glm::vec2 at)
{
    const float length = 8.0f * paint.size;
    const auto row = static_cast<int>(std::floor(at.x / paint.size));
    const float shift = length * randomAt(row, 1, 0, paint.seed);
    const auto column = static_cast<int>(std::floor((at.y + shift) / length));
    const float across = at.x / paint.size - std::floor(at.x / paint.size);
    const float shade = randomAt(row, column, 2, paint.seed);
    const float grain =
        noise({at.x * 60.0f, at.y * 3.0f, static_cast<float>(row)}, paint.seed + 1) * 0.15f;
    const glm::vec3 wood = glm::mix(paint.first, paint.second, std::clamp(shade + grain, 0.f, 1.f));
    return across < kGap ? 0.4f * wood : wood;
}

glm::vec3 blotchAlbedo(const Paint& paint, glm::vec2 at)
{
    // A rectangle is a cell of a coarse grid or of a fine one, as chance would have it.
    for (const float size : {paint.size, 0.4f * paint.size}) {
        const auto x = static_cast<int>(std::floor(at.x / size));
        const auto y = static_cast<int>(std::floor(at.y / size));
        if (size == paint.size && randomAt(x, y, 3, paint.seed) < 0.5f) continue;
        return {randomAt(x, y, 4, paint.seed), randomAt(x, y, 5, paint.seed),
                randomAt(x, y, 6, paint.seed)};
    }
    return paint.first;
}

glm::vec3 patternAt(const Paint& paint, glm::vec3 position, glm::vec3 normal)
{
    const glm::vec2 at = alongSurface(position, normal);
    const glm::vec2 cell = glm::floor(at / paint.size);
    const glm::vec2 inCell = at / paint.size - cell;
    switch (paint.pattern) {
    case Paint::plain:
        return paint.first;
    case Paint::stripes:
        return inCell.x < 0.5f ? paint.first : paint.second;
    case Paint::checks:
        return static_cast<int>(cell.x + cell.y) % 2 == 0 ? paint.first : paint.second;
    case Paint::tiles:
        return std::min(inCell.x, inCell.y) < kGrout ? paint.second : paint.first;
    case Paint::planks:
        return plankAlbedo(paint, at);
    case Paint::cloth:
        return glm::mix(paint.first, paint.second,
                        std::clamp(0.5f + noise(position / paint.size, paint.seed), 0.0f, 1.0f));
    case Paint::blotches:
        return blotchAlbedo(paint, at);
    }
    return paint.first;
}

} // namespace

float noise(glm::vec3 at, uint64_t seed)
{
    const glm::vec3 low = glm::floor(at);
    const glm::vec3 t = at - low;
    const glm::vec3 smooth = t * t * (3.0f - 2.0f * t);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 on(corner & 1, corner >> 1 & 1, corner >> 2);
        float weight = 1.0f;
        for (int c = 0; c < 3; ++c) weight *= on[c] != 0 ? smooth[c] : 1.0f - smooth[c];
        const glm::ivec3 cell = glm::ivec3(low) + on;
        sum += weight * (2.0f * randomAt(cell.x, cell.y, cell.z, seed) - 1.0f);
    }
    return sum;
}

glm::vec3 albedoOf(const Paint& paint, glm::vec3 position, glm::vec3 normal)
{
    return glm::clamp(patternAt(paint, position, normal), 0.03f, 0.9f);
}

} // namespace relamp::rooms
