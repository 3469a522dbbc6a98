#include "albedo/fill.h"

#include "base/parallel.h"

#include <cstdint>
#include <utility>

namespace relamp
{
namespace
{

constexpr int kMostPasses = 256; // each goes about two surfels inwards
constexpr int kSmoothings = 32;
constexpr float kHalfway = 0.71f; // cosine of 45 degrees: what is of both sides of a corner

/// Whether two neighbours are of one surface as far as paint goes: a surfel in a corner, of parts
/// of several surfaces, is of none.
bool facesAlike(const Surfels& surfels, uint32_t a, uint32_t b)
{
    return glm::dot(surfels.normal[a], surfels.normal[b]) > kHalfway;
}

/// Mean of what is around, over and over: what meets in the middle does so without an edge.
void smooth(const Surfels& surfels, std::span<const uint8_t> isKnown,
            std::span<const uint8_t> isReached, std::vector<glm::vec3>& values)
{
    std::vector<uint32_t> open;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (isKnown[s] == 0 && isReached[s] != 0) open.push_back(s);
    std::vector<glm::vec3> means(open.size());
    for (int pass = 0; pass < kSmoothings; ++pass) {
        forEachChunk(open.size(), 1024, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                glm::vec3 sum(0.0f);
                float count = 0.0f;
                for (const uint32_t n : surfels.neighborsOf(open[i])) {
                    if (isReached[n] == 0 || !facesAlike(surfels, open[i], n)) continue;
                    sum += values[n];
                    count += 1.0f;
                }
                means[i] = sum / count;
            }
        });
        for (size_t i = 0; i < open.size(); ++i) values[open[i]] = means[i];
    }
}

} // namespace

std::vector<glm::vec3> fillFromAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                      std::span<const uint8_t> isKnown, float otherwise)
{
    std::vector<glm::vec3> filled(surfels.count(), glm::vec3(otherwise));
    std::vector<uint8_t> known(isKnown.begin(), isKnown.end());
    std::vector<uint32_t> open;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (known[s] != 0)
            filled[s] = albedo[s];
        else
            open.push_back(s);
    for (int pass = 0; pass < kMostPasses && !open.empty(); ++pass) {
        std::vector<uint32_t> reached;
        std::vector<uint32_t> rest;
        for (const uint32_t s : open) {
            glm::vec3 sum(0.0f);
            float count = 0.0f;
            for (const uint32_t n : surfels.neighborsOf(s)) {
                if (known[n] == 0 || !facesAlike(surfels, s, n)) continue;
                sum += filled[n];
                count += 1.0f;
            }
            if (count > 0.0f) filled[s] = sum / count;
            (count > 0.0f ? reached : rest).push_back(s);
        }
        if (reached.empty()) break;
        for (const uint32_t s : reached) known[s] = 1;
        open = std::move(rest);
    }
    smooth(surfels, isKnown, known, filled);
    return filled;
}

} // namespace relamp
