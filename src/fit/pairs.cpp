#include "fit/pairs.h"

#include "lights/expand.shared.h"

#include <cmath>
#include <random>

namespace relamp
{
namespace
{

constexpr float kSamePlaneFacing = 0.97f; // cosine
constexpr float kSamePlaneStep = 0.05f;   // m off the plane
constexpr float kSameColor =
    0.6f; // length of the step in log r, g, b after brightness is taken out
constexpr float kDarkest = 0.004f; // luminance; below, a byte's steps are too coarse
constexpr size_t kTriesPerPair = 32;

/// Colour without brightness, in logs.
glm::vec3 chromaOf(glm::vec3 radiance)
{
    return glm::log(glm::max(radiance, glm::vec3(1e-4f)) / luminance(radiance));
}

class Matcher
{
public:
    Matcher(const FitData& data, std::span<const uint32_t> surfels, const Surfels& all)
        : surfels_(surfels), all_(all)
    {
        for (const glm::vec3 radiance : data.radiance) {
            chroma_.push_back(chromaOf(radiance));
            isDark_.push_back(luminance(radiance) < kDarkest ? 1 : 0);
        }
    }

    [[nodiscard]] bool couldBeOneMaterial(uint32_t p, uint32_t q) const;

private:
    std::span<const uint32_t> surfels_; // of places
    const Surfels& all_;
    std::vector<glm::vec3> chroma_; // of places
    std::vector<uint8_t> isDark_;
};

bool Matcher::couldBeOneMaterial(uint32_t p, uint32_t q) const
{
    if (isDark_[p] != 0 || isDark_[q] != 0) return false;
    const uint32_t a = surfels_[p];
    const uint32_t b = surfels_[q];
    if (glm::dot(all_.normal[a], all_.normal[b]) < kSamePlaneFacing) return false;
    if (std::abs(glm::dot(all_.position[b] - all_.position[a], all_.normal[a])) > kSamePlaneStep)
        return false;
    return glm::distance(chroma_[p], chroma_[q]) < kSameColor;
}

} // namespace

std::vector<MaterialPair> drawPairs(const FitData& data, std::span<const uint32_t> surfels,
                                    const Surfels& all, size_t perPlace)
{
    std::vector<MaterialPair> pairs;
    const auto places = static_cast<uint32_t>(data.places());
    if (places < 2) return pairs;
    const Matcher matcher(data, surfels, all);
    std::mt19937 random(1); // its raw numbers are the same everywhere; distributions need not be
    for (uint32_t p = 0; p < places; ++p) {
        size_t found = 0;
        for (size_t attempt = 0; attempt < kTriesPerPair * perPlace && found < perPlace;
             ++attempt) {
            const auto q = static_cast<uint32_t>(random() % places);
            if (q == p || !matcher.couldBeOneMaterial(p, q)) continue;
            pairs.push_back({p, q});
            ++found;
        }
    }
    return pairs;
}

} // namespace relamp
