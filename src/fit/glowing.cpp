#include "fit/glowing.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

float medianOf(std::vector<float> values)
{
    if (values.empty()) return 0.0f;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// A connected part of the surface that is about equally bright.
struct Part
{
    Glowing glowing;
    Candidate shape;
    bool isClear = false; // glows by itself, whatever is beside it
    bool isLevel = false; // faces up
};

class GlowSearch
{
public:
    GlowSearch(const Surfels& surfels, const SurfelRadiance& radiance, const LitSides& sides,
               std::span<const uint8_t> shines);

    std::vector<Glowing> run();

private:
    [[nodiscard]] bool isClear(uint32_t s) const
    {
        return isPlain(s) && whiteness_[s] > kUnsureLight * kUnsureLight;
    }
    [[nodiscard]] bool isPlain(uint32_t s) const
    {
        return radiance_.plainArea[s] > 0.0f && isHardlyBurntOut(radiance_, s);
    }
    template<class Holds>
    std::vector<uint32_t> flooded(std::vector<uint32_t> members, std::vector<uint8_t>& isTaken,
                                  const Holds& holds) const;
    [[nodiscard]] Part partOf(std::vector<uint32_t> members, float from) const;
    [[nodiscard]] bool endsSharply(const std::vector<uint32_t>& members) const;
    [[nodiscard]] float areaBesideLamps(const std::vector<uint32_t>& members) const;

    const Surfels& surfels_;
    const SurfelRadiance& radiance_;
    std::span<const uint8_t> shines_;
    std::vector<float> shown_;     // luminance
    std::vector<float> whiteness_; // how many times as white as the whitest paper
};

/// Few rays tell the light on a surfel, which may have missed a lamp: what is around it counts,
/// too. And in a dim corner the error of the light is as large as the light: there, what is
/// compared with is the mean light of the room.
GlowSearch::GlowSearch(const Surfels& surfels, const SurfelRadiance& radiance,
                       const LitSides& sides, std::span<const uint8_t> shines)
    : surfels_(surfels), radiance_(radiance), shines_(shines), shown_(surfels.count()),
      whiteness_(surfels.count())
{
    std::vector<float> own(surfels.count());
    double flux = 0.0;
    double area = 0.0;
    for (size_t s = 0; s < own.size(); ++s) {
        own[s] = luminance(sides.direct[s] + sides.gathered.irradiance[s]); // list s is its front's
        shown_[s] = luminance(radiance.plain[s]);
        if (shines[s] != 0) continue;
        flux += static_cast<double>(surfels.area[s] * own[s]);
        area += static_cast<double>(surfels.area[s]);
    }
    const auto usual = static_cast<float>(flux / std::max(area, 1e-9));
    forEach(own.size(), [&](size_t s) {
        float sum = 0.0f;
        for (const uint32_t n : surfels.neighborsOf(s)) sum += own[n];
        const float around = sum / static_cast<float>(surfels.neighborsOf(s).size());
        const float light = std::max({own[s], around, usual, kFaintest});
        whiteness_[s] = kPi * shown_[s] / (kWhitestPaper * light);
    });
}

/// Members and all that is connected to them and `holds`.
template<class Holds>
std::vector<uint32_t> GlowSearch::flooded(std::vector<uint32_t> members,
                                          std::vector<uint8_t>& isTaken, const Holds& holds) const
{
    for (const uint32_t s : members) isTaken[s] = 1;
    for (size_t k = 0; k < members.size(); ++k)
        for (const uint32_t n : surfels_.neighborsOf(members[k])) {
            if (isTaken[n] != 0 || !holds(n)) continue;
            isTaken[n] = 1;
            members.push_back(n);
        }
    return members;
}

/// Whether what is around is paint: errors of the light fade.
bool GlowSearch::endsSharply(const std::vector<uint32_t>& members) const
{
    std::vector<uint32_t> inside = members;
    std::sort(inside.begin(), inside.end());
    std::vector<float> rim;
    for (const uint32_t s : members)
        for (const uint32_t n : surfels_.neighborsOf(s))
            if (!std::binary_search(inside.begin(), inside.end(), n)) rim.push_back(whiteness_[n]);
    return medianOf(std::move(rim)) < kUnsureLight;
}

float GlowSearch::areaBesideLamps(const std::vector<uint32_t>& members) const
{
    float area = 0.0f;
    for (const uint32_t s : members) {
        const std::span around = surfels_.neighborsOf(s);
        if (std::any_of(around.begin(), around.end(), [&](uint32_t n) {
                return shines_[n] != 0 || !isHardlyBurntOut(radiance_, n);
            }))
            area += surfels_.area[s];
    }
    return area;
}

Part GlowSearch::partOf(std::vector<uint32_t> members, float from) const
{
    std::vector<ClippedPatch> patches;
    float clear = 0.0f;
    for (const uint32_t s : members) {
        patches.push_back({surfels_.position[s], surfels_.normal[s], surfels_.area[s], s});
        if (isClear(s)) clear += surfels_.area[s];
    }
    Part part{.shape = candidateOf(std::move(patches))};
    part.isLevel = part.shape.normal.y > kSameFacing;
    part.isClear = !part.isLevel && part.shape.area >= kSpeck && 2.0f * clear > part.shape.area &&
                   2.0f * areaBesideLamps(members) < part.shape.area && endsSharply(members);
    part.glowing = {std::move(members), from};
    return part;
}

std::vector<Glowing> GlowSearch::run()
{
    std::vector<Part> parts;
    std::vector<uint8_t> isSeed(surfels_.count(), 0);
    std::vector<uint8_t> isTaken(surfels_.count(), 0);
    for (uint32_t s = 0; s < surfels_.count(); ++s) {
        if (isSeed[s] != 0 || isTaken[s] != 0 || !isClear(s)) continue;
        std::vector<uint32_t> seeds = flooded({s}, isSeed, [&](uint32_t n) { return isClear(n); });
        std::vector<float> shown;
        for (const uint32_t m : seeds) shown.push_back(shown_[m]);
        const float from = medianOf(std::move(shown)) / kUnsureLight;
        std::erase_if(seeds, [&](uint32_t m) { return isTaken[m] != 0; });
        if (seeds.empty()) continue;
        parts.push_back(partOf(flooded(std::move(seeds), isTaken,
                                       [&](uint32_t n) { return isPlain(n) && shown_[n] >= from; }),
                               from));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.shape.area > b.shape.area; });
    std::vector<Glowing> found;
    for (Part& part : parts) {
        const auto isOf = [&](const Part& lamp) {
            return lamp.isClear && part.shape.area < lamp.shape.area &&
                   (!part.isLevel || part.shape.area < kPaneArea) &&
                   areTouching(part.shape, lamp.shape);
        };
        if (part.isClear || std::any_of(parts.begin(), parts.end(), isOf))
            found.push_back(part.glowing);
    }
    return found;
}

/// Mean by area.
glm::vec3 shownBy(std::span<const ClippedPatch> patches)
{
    glm::vec3 sum(0.0f);
    float area = 0.0f;
    for (const ClippedPatch& patch : patches) {
        sum += patch.area * patch.radiance;
        area += patch.area;
    }
    return sum / std::max(area, 1e-9f);
}

/// A lamp whose surface was seen as it is, most of it, has the radiance that it shows, unless the
/// light that it throws is clearly more.
void raise(std::span<const uint8_t> isGlowing, const FoundLamp& lamp, glm::vec3& power)
{
    std::vector<ClippedPatch> seen;
    float area = 0.0f;
    for (const ClippedPatch& patch : lamp.patches) {
        area += patch.area;
        if (patch.surfel != Surfels::kNone && isGlowing[patch.surfel] != 0) seen.push_back(patch);
    }
    if (lamp.isSunlit || 2.0f * candidateOf(seen).area < area) return;
    const glm::vec3 shown = shownBy(seen);
    const float more = std::log(luminance(power) / std::max(luminance(shown), kFaintest));
    if (more < 2.0f * lamp.logError.g) power = shown;
}

/// The pieces without what is a lamp already.
std::vector<Candidate> missingOf(std::span<const Glowing> glowing, std::span<const uint8_t> isFound,
                                 const SurfelRadiance& radiance)
{
    std::vector<Candidate> missing;
    for (const Glowing& piece : glowing) {
        std::vector<ClippedPatch> patches;
        for (const uint32_t s : piece.surfels) {
            const auto patch = std::lower_bound(
                radiance.clipped.begin(), radiance.clipped.end(), s,
                [](const ClippedPatch& of, uint32_t surfel) { return of.surfel < surfel; });
            if (isFound[s] == 0 && patch != radiance.clipped.end() && patch->surfel == s)
                patches.push_back(*patch);
        }
        if (!patches.empty()) missing.push_back(candidateOf(std::move(patches)));
    }
    return missing;
}

/// Pieces that touch are one lamp.
std::vector<Candidate> joined(std::vector<Candidate> pieces)
{
    std::vector<Candidate> lamps;
    for (Candidate& piece : pieces) {
        std::vector<ClippedPatch> patches = std::move(piece.patches);
        for (bool isAny = true; isAny;) {
            const Candidate so{.patches = patches};
            const auto touching =
                std::find_if(lamps.begin(), lamps.end(),
                             [&](const Candidate& lamp) { return areTouching(lamp, so); });
            isAny = touching != lamps.end();
            if (!isAny) break;
            patches.insert(patches.end(), touching->patches.begin(), touching->patches.end());
            lamps.erase(touching);
        }
        lamps.push_back(candidateOf(std::move(patches)));
    }
    return lamps;
}

} // namespace

std::vector<Glowing> findGlowing(const Surfels& surfels, const SurfelRadiance& radiance,
                                 const LitSides& sides, std::span<const uint8_t> shines)
{
    return GlowSearch(surfels, radiance, sides, shines).run();
}

void addGlowing(std::span<const Glowing> glowing, const SurfelRadiance& radiance, FoundLamps& found)
{
    if (glowing.empty()) return;
    std::vector<uint8_t> isGlowing(radiance.plain.size(), 0);
    for (const Glowing& piece : glowing)
        for (const uint32_t s : piece.surfels) isGlowing[s] = 1;
    std::vector<uint8_t> isFound(radiance.plain.size(), 0);
    for (size_t l = 0; l < found.lamps.size(); ++l) {
        raise(isGlowing, found.lamps[l], found.powers.lamps[l]);
        for (const ClippedPatch& patch : found.lamps[l].patches)
            if (patch.surfel != Surfels::kNone) isFound[patch.surfel] = 1;
    }
    auto place = std::find_if(found.lamps.begin(), found.lamps.end(),
                              [](const FoundLamp& lamp) { return lamp.isSunlit; }) -
                 found.lamps.begin(); // patches of sun come behind lamps
    for (Candidate& lamp : joined(missingOf(glowing, isFound, radiance))) {
        const glm::vec3 shown = shownBy(lamp.patches);
        const float error = errorOfArea(lamp.area);
        found.lamps.insert(found.lamps.begin() + place,
                           {.patches = std::move(lamp.patches), .logError = glm::vec3(error)});
        found.powers.lamps.insert(found.powers.lamps.begin() + place, shown);
        ++place;
    }
}

} // namespace relamp
