#include "albedo/fill.h"

#include <cstdint>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kGrey = 0.5f;
constexpr int kMostPasses = 256; // each goes about two surfels inwards

} // namespace

std::vector<glm::vec3> fillFromAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                      std::span<const uint8_t> isKnown)
{
    std::vector<glm::vec3> filled(surfels.count(), glm::vec3(kGrey));
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
                if (known[n] == 0) continue;
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
    return filled;
}

} // namespace relamp
