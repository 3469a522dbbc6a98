#include "fit/suspects.h"

#include "base/disjoint_sets.h"
#include "base/radiometry.shared.h"
#include "fit/lamp_groups.h"

#include <algorithm>
#include <map>
#include <set>

namespace relamp
{
namespace
{

constexpr float kTouching = 0.12f;     // m between pieces of one lamp
constexpr float kAboutEqual = 3.0f;    // ratio of their radiances
constexpr float kEqual = 1.5f;         // likewise, of panes of one window
constexpr float kOneFacing = 0.95f;    // cosine
constexpr float kOneLevel = 0.05f;     // m
constexpr float kLeastModel = 0.003f;  // m^2; the shape of less says nothing
constexpr float kSmallSuspect = 0.02f; // m^2; a scan may show half of it, or twice as much
constexpr float kSamePower = 2.0f;     // ratio
constexpr float kNoWall = 2.0f;        // luminance; walls' pieces agree in being about white
constexpr size_t kLeastFamily = 4;
constexpr size_t kFewBodies = 2;  // that are enough of a family
constexpr float kWhole = 0.3f;    // length of a mean normal; what is shorter faces all around
constexpr float kSameBody = 1.3f; // ratio of areas
constexpr float kSliver = 0.02f;  // ratio of areas; too small beside a lamp to be one of its own

bool areOneLamp(const Suspect& a, const Suspect& b)
{
    if (!a.ends.empty() || !b.ends.empty()) return false;
    if (a.body == b.body) return true;
    const float ratio = luminance(a.radiance) / luminance(b.radiance);
    const bool isEqual = ratio < kAboutEqual && ratio > 1.0f / kAboutEqual;
    const auto [less, more] = std::minmax(a.candidate.area, b.candidate.area);
    return (isEqual || less < kSliver * more) && areWithin(a.candidate, b.candidate, kTouching);
}

void add(const Suspect& piece, Suspect& whole)
{
    whole.isGiven |= piece.isGiven;
    std::vector<ClippedPatch> patches = std::move(whole.candidate.patches);
    patches.insert(patches.end(), piece.candidate.patches.begin(), piece.candidate.patches.end());
    whole.candidate = candidateOf(std::move(patches));
    for (size_t i = 0; i < whole.direct.size(); ++i) whole.direct[i] += piece.direct[i];
}

/// Whether two are burnt out all around, and of one size: globes of one model. A wall is burnt out
/// on one side.
bool areAlikeBodies(const Candidate& a, const Candidate& b)
{
    const float sizes = a.area / b.area;
    return std::max(glm::length(a.normal), glm::length(b.normal)) < kWhole && sizes < kSameBody &&
           sizes > 1.0f / kSameBody;
}

bool areOneModel(const Candidate& a, const Candidate& b)
{
    return areAlike(a, b) || areAlikeBodies(a, b);
}

/// Whether two small pieces, or whole bodies, are brighter than walls, look alike and have about
/// one power: where they were fitted by themselves and agree, they are hardly flaws. Large ones
/// speak for themselves.
bool agree(const Suspect& a, const Suspect& b)
{
    if (a.isUnseen || b.isUnseen || !areOneModel(a.candidate, b.candidate)) return false;
    const bool areSmall = std::max(a.candidate.area, b.candidate.area) < kSmallSuspect;
    if (!areSmall && !areAlikeBodies(a.candidate, b.candidate)) return false;
    const float ratio = a.power() / b.power();
    return ratio < kSamePower && ratio > 1.0f / kSamePower &&
           std::min(luminance(a.radiance), luminance(b.radiance)) > kNoWall;
}

} // namespace

float Suspect::power() const
{
    return candidate.area * luminance(radiance);
}

size_t Suspect::rays() const
{
    return raysToGroup(std::max<size_t>(ends.size(), 1));
}

float Suspect::reach() const
{
    const auto see = std::count_if(direct.begin(), direct.end(), [](float d) { return d > 0.0f; });
    return static_cast<float>(see) / static_cast<float>(std::max<size_t>(direct.size(), 1));
}

bool arePanesOfOne(const Suspect& a, const Suspect& b)
{
    const glm::vec3 along = a.candidate.normal;
    const float ratio = luminance(a.radiance) / luminance(b.radiance);
    return ratio < kEqual && ratio > 1.0f / kEqual &&
           glm::dot(along, b.candidate.normal) > kOneFacing * kOneFacing &&
           std::abs(glm::dot(b.candidate.centre - a.candidate.centre, along)) < kOneLevel &&
           areWithin(a.candidate, b.candidate, kTouching);
}

std::vector<AlikeLamps> alikesOf(const std::vector<Suspect>& suspects)
{
    std::vector<AlikeLamps> alike;
    for (uint32_t a = 0; a < suspects.size(); ++a)
        for (uint32_t b = a + 1; b < suspects.size(); ++b) {
            const Suspect& one = suspects[a];
            const Suspect& other = suspects[b];
            const float areaOfA = one.candidate.area;
            const float areaOfB = other.candidate.area;
            const bool areSmall = std::min(areaOfA, areaOfB) < kLeastModel;
            if (one.body == other.body ||
                (!areSmall && areOneModel(one.candidate, other.candidate)))
                alike.push_back({a, b});
            else if (areSmall && agree(one, other))
                alike.push_back({a, b, areaOfB / areaOfA});
        }
    return alike;
}

std::vector<uint32_t> familyOf(const std::vector<Suspect>& suspects, uint32_t f)
{
    std::vector<uint32_t> family;
    for (uint32_t other = 0; other < suspects.size(); ++other)
        if (other == f || agree(suspects[f], suspects[other])) family.push_back(other);
    const bool isWhole = glm::length(suspects[f].candidate.normal) < kWhole;
    if (family.size() < (isWhole ? kFewBodies : kLeastFamily)) family = {f};
    return family;
}

void findShares(const FitData& data, glm::vec3 ambient, std::vector<Suspect>& suspects)
{
    std::vector<float> radiance;
    for (const Suspect& suspect : suspects) radiance.push_back(luminance(suspect.radiance));
    std::vector<float> sums(suspects.size(), 0.0f);
    for (size_t i = 0; i < data.places(); ++i) {
        const float* direct = data.direct.data() + i * data.lamps;
        float all = luminance(data.gathered[i]) + luminance(ambient) * data.missed[i];
        for (size_t f = 0; f < data.lamps; ++f) all += radiance[f] * direct[f];
        if (all <= 0.0f) continue;
        for (size_t f = 0; f < data.lamps; ++f) sums[f] += radiance[f] * direct[f] / all;
    }
    for (size_t f = 0; f < suspects.size(); ++f)
        suspects[f].share = sums[f] / static_cast<float>(std::max<size_t>(data.places(), 1));
}

size_t dropHalves(std::vector<Suspect>& suspects)
{
    std::set<size_t> bodies;
    for (const Suspect& suspect : suspects)
        if (!suspect.isUnseen) bodies.insert(suspect.body);
    return std::erase_if(suspects, [&](const Suspect& suspect) {
        return suspect.isUnseen && !bodies.contains(suspect.body);
    });
}

std::vector<uint8_t> goneWith(const std::vector<Suspect>& suspects, size_t f)
{
    std::vector<uint8_t> gone(suspects.size(), 0);
    gone[f] = 1;
    for (size_t other = 0; other < gone.size(); ++other)
        if (suspects[other].isUnseen && !suspects[f].isUnseen &&
            suspects[other].body == suspects[f].body)
            gone[other] = 1;
    return gone;
}

void joinPieces(std::vector<Suspect>& suspects)
{
    DisjointSets sets(suspects.size());
    for (uint32_t a = 0; a < suspects.size(); ++a)
        for (uint32_t b = a + 1; b < suspects.size(); ++b)
            if (areOneLamp(suspects[a], suspects[b])) sets.join(a, b);
    std::map<uint32_t, Suspect> joined;
    for (uint32_t f = 0; f < suspects.size(); ++f) {
        const auto [whole, isNew] = joined.try_emplace(sets.find(f), suspects[f]);
        if (!isNew) add(suspects[f], whole->second);
    }
    suspects.clear();
    for (auto& [root, suspect] : joined) suspects.push_back(std::move(suspect));
}

} // namespace relamp
