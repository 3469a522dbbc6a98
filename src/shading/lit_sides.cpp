#include "shading/lit_sides.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "shading/lamp_patches.h"
#include "shading/lit_sides.shared.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kOrigins = 4;       // texels of a surfel that a lamp is looked for from
constexpr size_t kOriginsOfBack = 2; // of which only the mean of many counts

// Numerics.
constexpr size_t kSidesOfScout = 8; // of all, which follow each other through space
constexpr size_t kTurnOfScout = 5;  // odd, so that scouts take all turns

std::vector<glm::vec3> meanOfNeighbors(const Surfels& surfels, std::span<const glm::vec3> values)
{
    std::vector<glm::vec3> means(values.size());
    forEachChunk(means.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            const std::span around = surfels.neighborsOf(s); // with itself
            glm::vec3 sum(0.0f);
            for (const uint32_t n : around) sum += values[n];
            means[s] = sum / static_cast<float>(around.size());
        }
    });
    return means;
}

/// Sides, and the texels that lamps are looked for from: a chunk of lists.
class Lookouts
{
public:
    static constexpr size_t kMost = LampSight::kBlock;

    explicit Lookouts(const SurfelSites& sites) : sites_(sites) {}

    void add(Side side)
    {
        const size_t first = block_.count;
        for (size_t k = 0; k < (side.isBack() ? kOriginsOfBack : kOrigins); ++k) {
            TexelSite origin = sites_.at(side.surfel(), k);
            if (side.isBack()) origin.normal = -origin.normal;
            block_.x[block_.count] = origin.position.x;
            block_.y[block_.count] = origin.position.y;
            block_.z[block_.count] = origin.position.z;
            block_.nx[block_.count] = origin.normal.x;
            block_.ny[block_.count] = origin.normal.y;
            block_.nz[block_.count] = origin.normal.z;
            origins_[block_.count++] = origin;
        }
        sides_[count_++] = {side, first};
        sides_[count_].first = block_.count;
    }

    /// Whether anything of a lamp is seen.
    [[nodiscard]] bool see(const RayScene& scene, const SoughtLamp& lamp) const
    {
        AreaSample seen[kMost];
        castRays(scene, lamp, seen);
        return std::any_of(seen, seen + count_, [](AreaSample s) { return s.visible > 0.0f; });
    }

    /// What all see of a lamp: rays say which share of it, all its patches how much that is.
    void look(const RayScene& scene, const SoughtLamp& lamp, const LampPatches& patches,
              std::span<AreaSample> seen) const
    {
        castRays(scene, lamp, seen);
        float open[TexelBlock::kPadded];
        openIrradiance(block_, patches, Geometry::scanned, open);
        for (size_t i = 0; i < count_; ++i) {
            if (seen[i].open <= 0.0f) continue;
            float sum = 0.0f;
            for (size_t k = sides_[i].first; k < sides_[i + 1].first; ++k) sum += open[k];
            const float mean = sum / static_cast<float>(originsOf(i).size());
            seen[i].visible = seen[i].visible / seen[i].open * mean; // all of it is all
            seen[i].open = mean;
        }
    }

private:
    struct Looking
    {
        Side side;
        size_t first; // of its origins
    };

    [[nodiscard]] std::span<const TexelSite> originsOf(size_t i) const
    {
        return {origins_ + sides_[i].first, origins_ + sides_[i + 1].first};
    }

    void castRays(const RayScene& scene, const SoughtLamp& lamp, std::span<AreaSample> seen) const
    {
        AreaSampler sampler(scene, lamp.light, Geometry::scanned);
        for (size_t i = 0; i < count_; ++i)
            sampler.add(originsOf(i), lamp.raysPerOrigin,
                        seededShift(sites_.seed(), sides_[i].side.index, 0), seen[i]);
        sampler.finish();
    }

    const SurfelSites& sites_;
    TexelBlock block_; // of all origins
    TexelSite origins_[kMost * kOrigins];
    Looking sides_[kMost + 1]; // and one more
    size_t count_ = 0;
};
static_assert(Lookouts::kMost * kOrigins <= TexelBlock::kCapacity);

/// What a block of lists sees of a lamp.
struct SeenLamp
{
    size_t lamp;
    size_t block;
    LampSight::Kept kept;
};

/// The rooms that a lamp's surfaces are in; all where it has none that was scanned.
RoomSet roomsOf(const AreaLight& light, const HitLists& hits)
{
    RoomSet rooms;
    for (const ClippedPatch& patch : light.patches())
        if (patch.surfel != Surfels::kNone) rooms |= hits.roomOf(patch.surfel);
    return rooms.any() ? rooms : RoomSet().set();
}

} // namespace

bool knowsItsAlbedo(const SurfelRadiance& radiance, size_t surfel)
{
    return radiance.plainArea[surfel] > 0.1f * radiance.clippedArea[surfel];
}

std::vector<float> noiseAround(const Surfels& surfels, std::span<const float> noise)
{
    std::vector<float> around(surfels.count());
    forEach(around.size(), [&](size_t s) {
        float squared = 0.0f;
        for (const uint32_t n : surfels.neighborsOf(s)) squared += noise[n] * noise[n];
        around[s] = std::sqrt(squared / static_cast<float>(surfels.neighborsOf(s).size()));
    });
    return around;
}

std::vector<glm::vec3> withoutNoise(const Surfels& surfels, std::span<const glm::vec3> values,
                                    std::span<const float> noise)
{
    std::vector<glm::vec3> result = meanOfNeighbors(surfels, values);
    forEach(result.size(), [&](size_t s) {
        const glm::vec3 way = result[s] - values[s];
        result[s] = values[s] + shareOfNoise(luminance(glm::abs(way)), noise[s] * noise[s]) * way;
    });
    return result;
}

std::vector<glm::vec3> albedoOf(const Texels& texels, const SurfelRadiance& radiance,
                                std::span<const glm::vec3> irradiance)
{
    std::vector<glm::vec3> albedo(texels.surfels.count());
    forEach(albedo.size(), [&](size_t s) {
        albedo[s] = albedoUnder(irradiance[s], radiance.sent(s, radiance.plain[s]));
    });
    guessBurntOut(texels, radiance, albedo);
    return albedo;
}

void guessBurntOut(const Texels& texels, const SurfelRadiance& radiance,
                   std::span<glm::vec3> albedo)
{
    forEach(albedo.size(), [&](size_t s) {
        if (knowsItsAlbedo(radiance, s)) return;
        glm::vec3 sum(0.0f);
        float count = 0.0f;
        for (const uint32_t n : texels.surfels.neighborsOf(s)) {
            if (!knowsItsAlbedo(radiance, n)) continue;
            sum += albedo[n];
            count += 1.0f;
        }
        albedo[s] = count > 0.0f ? sum / count : glm::vec3(kAlbedoOfTheUnknown);
    });
}

std::vector<LampSight> directOfLists(const Texels& texels, const RayScene& scene,
                                     const HitLists& hits, std::span<const SoughtLamp> lamps,
                                     std::span<const uint32_t> lists, size_t perScout)
{
    const SurfelSites sites(texels);
    const size_t count = lists.empty() ? hits.sideOfList.size() : lists.size();
    std::vector<LampPatches> patches;
    for (const SoughtLamp& lamp : lamps) patches.emplace_back(lamp.light);
    std::vector<LampSight> direct(lamps.size(), LampSight(count));
    // One of every `step`, each time another of these: sides follow each other in a pattern, as the
    // front and the back of a door in turns.
    const auto lookoutsOf = [&](size_t begin, size_t end, size_t step) {
        Lookouts lookouts(sites);
        for (size_t i = begin, turn = 0; i < end; i += step, turn = (turn + kTurnOfScout) % step) {
            const size_t one = std::min(i + turn, end - 1);
            lookouts.add(hits.sideOfList[lists.empty() ? one : lists[one]]);
        }
        return lookouts;
    };
    std::vector<RoomSet> rooms;
    for (const SoughtLamp& lamp : lamps) rooms.push_back(roomsOf(lamp.light, hits));
    if (lists.empty()) perScout = kSidesOfScout;
    const size_t chunk = perScout * Lookouts::kMost;
    std::vector<std::vector<SeenLamp>> seenBy((count + chunk - 1) / chunk);
    forEachChunk(count, chunk, [&](size_t begin, size_t end) {
        RoomSet around;
        for (size_t i = begin; i < end; ++i)
            around |= hits.roomsSeenBy(hits.sideOfList[lists.empty() ? i : lists[i]].surfel());
        std::vector<uint8_t> isSeen(lamps.size());
        for (size_t l = 0; l < lamps.size(); ++l) isSeen[l] = (rooms[l] & around).any() ? 1 : 0;
        if (perScout > 1) {
            const Lookouts scouts = lookoutsOf(begin, end, perScout);
            for (size_t l = 0; l < lamps.size(); ++l)
                if (isSeen[l] != 0) isSeen[l] = scouts.see(scene, lamps[l]) ? 1 : 0;
        }
        for (size_t first = begin; first < end; first += Lookouts::kMost) {
            const size_t last = std::min(first + Lookouts::kMost, end);
            const Lookouts lookouts = lookoutsOf(first, last, 1);
            for (size_t l = 0; l < lamps.size(); ++l) {
                if (isSeen[l] == 0) continue;
                AreaSample seen[Lookouts::kMost];
                lookouts.look(scene, lamps[l], patches[l], seen);
                if (auto kept = LampSight::kept(std::span(seen).first(last - first)))
                    seenBy[begin / chunk].push_back(
                        {l, first / LampSight::kBlock, std::move(kept)});
            }
        }
    });
    for (std::vector<SeenLamp>& some : seenBy)
        for (SeenLamp& seen : some) direct[seen.lamp].put(seen.block, std::move(seen.kept));
    return direct;
}

LampSight directOfLists(const Texels& texels, const RayScene& scene, const HitLists& hits,
                        const SoughtLamp& lamp)
{
    return std::move(directOfLists(texels, scene, hits, {&lamp, 1}, {}).front());
}

namespace
{

/// What the sides send on of the light that they gathered. `least`: what the texture shows of
/// burnt-out walls.
void sendOn(const Texels& texels, const HitLists& hits, const SurfelRadiance& radiance,
            std::span<const glm::vec3> least, LitSides& sides)
{
    std::vector<glm::vec3> irradiance(sides.direct.size());
    forEach(irradiance.size(),
            [&](size_t i) { irradiance[i] = sides.direct[i] + sides.gathered.irradiance[i]; });
    sides.albedo = albedoOf(texels, radiance, irradiance);
    forEach(sides.albedo.size(), [&](size_t s) {
        const glm::vec3 front = irradiance[static_cast<size_t>(hits.listOfSide[2 * s])];
        sides.field.clipped[s] =
            burntOutRadiance(sides.albedo[s], front, least[s], radiance.whiteOf(s));
        if (const int32_t back = hits.listOfSide[2 * s + 1]; back != HitLists::kNoList)
            sides.field.back[s] = sides.albedo[s] * irradiance[static_cast<size_t>(back)] / kPi;
    });
}

} // namespace

LitSides lightSides(const Texels& texels, const HitLists& hits, const SurfelRadiance& radiance,
                    std::vector<glm::vec3> direct, std::span<const uint8_t> shines,
                    const OutsideLight& outside, std::optional<Gathered> settled)
{
    LitSides sides{.field = fieldOf(radiance), .direct = std::move(direct)};
    sides.field.shines.assign(shines.begin(), shines.end());
    sides.field.outside = outside;
    const std::vector<glm::vec3> least = sides.field.clipped;
    if (settled) {
        sides.gathered = *std::move(settled);
        sendOn(texels, hits, radiance, least, sides);
        return sides;
    }
    const SettlingGather settling(hits, sides.field);
    for (int round = 0; round < kLitSidesRounds; ++round) {
        sides.gathered = settling.gather(sides.field);
        sendOn(texels, hits, radiance, least, sides);
    }
    return sides;
}

std::vector<glm::vec3> indirectOfFronts(const Surfels& surfels, const HitLists& hits,
                                        const LitSides& sides)
{
    RadianceField plain = sides.field;
    for (glm::vec3& radiance : plain.clipped) radiance = glm::min(radiance, glm::vec3(1.0f));
    const Gathered even = gather(hits, plain);
    std::vector<glm::vec3> excess(surfels.count());
    std::vector<glm::vec3> indirect(surfels.count());
    forEach(surfels.count(), [&](size_t s) {
        excess[s] = sides.gathered.irradiance[s] - even.irradiance[s];
        indirect[s] = even.irradiance[s];
    });
    for (int pass = 0; pass < kExcessSmoothings; ++pass) excess = meanOfNeighbors(surfels, excess);
    indirect = withoutNoise(surfels, indirect, noiseAround(surfels, even.noise));
    forEach(surfels.count(), [&](size_t s) { indirect[s] += excess[s]; });
    return indirect;
}

} // namespace relamp
