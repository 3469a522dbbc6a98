#include "fit/bright_walls.h"

#include "base/radiometry.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr float kBrightWall = 0.75f; // albedo of what burns out first
constexpr size_t kLooks = 16;        // surfels of a lamp, to see what lights it
constexpr size_t kRays = 4;          // from each place of a side

/// Fronts of some of its surfels.
std::vector<uint32_t> looksAt(std::span<const ClippedPatch> lamp)
{
    std::vector<uint32_t> lists;
    for (const ClippedPatch& patch : lamp)
        if (patch.surfel != Surfels::kNone) lists.push_back(patch.surfel);
    const size_t looks = std::min(kLooks, lists.size());
    for (size_t k = 0; k < looks; ++k) lists[k] = lists[k * lists.size() / looks];
    lists.resize(looks);
    return lists;
}

} // namespace

BrightWalls::BrightWalls(const Texels& texels, const RayScene& scene, const HitLists& hits,
                         std::span<const std::span<const ClippedPatch>> lamps)
    : hits_(hits), first_{0}
{
    std::vector<SoughtLamp> sought;
    for (const std::span<const ClippedPatch> lamp : lamps) {
        const std::vector<uint32_t> lists = looksAt(lamp);
        lists_.insert(lists_.end(), lists.begin(), lists.end());
        first_.push_back(lists_.size());
        sought.push_back({AreaLight({lamp.begin(), lamp.end()}), kRays});
    }
    if (!lists_.empty()) light_ = directOfLists(texels, scene, hits, sought, lists_);
}

float BrightWalls::insteadOf(size_t lamp, const RadianceField& field, glm::vec3 ambient,
                             std::span<const glm::vec3> radiances) const
{
    const size_t first = first_[lamp];
    const size_t count = first_[lamp + 1] - first;
    if (count == 0) return 0.0f;
    const Gathered gathered = gather(hits_, field, std::span(lists_).subspan(first, count));
    std::vector<glm::vec3> irradiance;
    for (size_t k = 0; k < count; ++k)
        irradiance.push_back(gathered.irradiance[k] + ambient * gathered.missed[k]);
    for (size_t other = 0; other < radiances.size(); ++other)
        if (other != lamp)
            addDirect(std::span(light_[other]).subspan(first, count), radiances[other], irradiance);
    const auto middle = irradiance.begin() + static_cast<ptrdiff_t>(count / 2);
    std::nth_element(irradiance.begin(), middle, irradiance.end(),
                     [](glm::vec3 a, glm::vec3 b) { return luminance(a) < luminance(b); });
    return kBrightWall * luminance(*middle) / kPi;
}

} // namespace relamp
