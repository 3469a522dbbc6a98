#include "shading/lamp_patches.h"

#include "base/lanes.h"
#include "base/radiometry.shared.h"
#include "shading/lamp_patches.shared.h"
#include "shading/mesh_noise.shared.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kNear = 3.25f; // radii of a patch from its middle; nearer its parts are asked
constexpr float kFar = 4.25f;
constexpr float kFlat = 0.97f;   // length of the mean normal; a cap of 20 degrees
constexpr float kLarge = 256.0f; // a lamp of so many patches is round enough from afar
constexpr float kEverywhere = 1e30f;

/// Makes the tree of a lamp's patches.
class Planter
{
public:
    Planter(std::span<const ClippedPatch> patches, LampPatches& tree)
        : patches_(patches), tree_(tree)
    {
        for (const ClippedPatch& patch : patches) all_ += patch.area;
    }

    void plant()
    {
        std::vector<uint32_t> order(patches_.size());
        std::iota(order.begin(), order.end(), 0u);
        for (int side = 0; side < 6; ++side) { // what looks to the other side is no part of a patch
            const auto end = std::stable_partition(order.begin(), order.end(),
                                                   [&](uint32_t i) { return sideOf(i) != side; });
            add({end, order.end()}, 0);
            order.erase(end, order.end());
        }
    }

private:
    /// The one of a cube's sides that a patch faces most.
    [[nodiscard]] int sideOf(uint32_t patch) const
    {
        const glm::vec3 n = patches_[patch].normal;
        const glm::vec3 size = glm::abs(n);
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        return 2 * axis + (n[axis] < 0.0f ? 1 : 0);
    }

    void add(std::span<uint32_t> members, uint8_t depth)
    {
        if (members.empty()) return;
        const size_t own = addPatch(members, depth);
        if (members.size() > 1 && depth + 1 < kMostDepth) {
            const std::span<uint32_t> half = halved(members);
            for (const std::span<uint32_t> part : {half, members.subspan(half.size())}) {
                const std::span<uint32_t> quarter = halved(part);
                add(quarter, depth + 1);
                add(part.subspan(quarter.size()), depth + 1);
            }
        }
        tree_.after[own] = static_cast<uint32_t>(tree_.count());
    }

    size_t addPatch(std::span<const uint32_t> members, uint8_t depth)
    {
        float area = 0.0f;
        glm::vec3 middle(0.0f);
        glm::vec3 normal(0.0f);
        for (const uint32_t i : members) {
            area += patches_[i].area;
            middle += patches_[i].area * patches_[i].position;
            normal += patches_[i].area * patches_[i].normal;
        }
        middle /= area;
        normal /= area;
        float spread = 0.0f;
        float radius = 0.0f;
        for (const uint32_t i : members) {
            const glm::vec3 off = patches_[i].position - middle;
            const float own = patches_[i].area;
            spread += own * (0.5f * glm::dot(off, off) + own / (4.0f * kPi));
            radius = std::max(radius, glm::length(off) + std::sqrt(0.5f * own));
        }
        const bool isRound =
            members.size() > 1 && glm::length(normal) < kFlat && kLarge * area > all_;
        append(middle, normal, area, depth);
        tree_.spread.push_back(spread / area);
        tree_.farSquared.push_back(isRound ? kEverywhere : kFar * kFar * radius * radius);
        tree_.perRamp.push_back(isRound ? 1.0f
                                        : 1.0f / ((kFar * kFar - kNear * kNear) * radius * radius));
        return tree_.count() - 1;
    }

    void append(glm::vec3 middle, glm::vec3 normal, float area, uint8_t depth)
    {
        tree_.x.push_back(middle.x);
        tree_.y.push_back(middle.y);
        tree_.z.push_back(middle.z);
        tree_.nx.push_back(normal.x);
        tree_.ny.push_back(normal.y);
        tree_.nz.push_back(normal.z);
        tree_.area.push_back(area);
        tree_.after.push_back(0);
        tree_.depth.push_back(depth);
    }

    /// Orders members along their longest extent; the first half of them.
    std::span<uint32_t> halved(std::span<uint32_t> members)
    {
        glm::vec3 low(kEverywhere);
        glm::vec3 high(-kEverywhere);
        for (const uint32_t i : members) {
            low = glm::min(low, patches_[i].position);
            high = glm::max(high, patches_[i].position);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        const size_t half = (members.size() + 1) / 2;
        std::nth_element(members.begin(), members.begin() + static_cast<ptrdiff_t>(half) - 1,
                         members.end(), [&](uint32_t a, uint32_t b) {
                             const float pa = patches_[a].position[axis];
                             const float pb = patches_[b].position[axis];
                             return pa != pb ? pa < pb : a < b;
                         });
        return members.first(half);
    }

    std::span<const ClippedPatch> patches_;
    LampPatches& tree_;
    float all_ = 0.0f; // m^2
};

struct OpenArgs
{
    const TexelBlock* block;
    const LampPatches* lamp;
    float* irradiance;
};

template<Geometry geometry>
void openKernel(const OpenArgs& args)
{
    const TexelBlock& block = *args.block;
    const LampPatches& lamp = *args.lamp;
    const auto patches = static_cast<uint32_t>(lamp.count());
    float asked[kMostDepth + 1][kLanes]; // of the patches at a depth
    uint32_t isAsked[kMostDepth + 1] = {1};
    for (size_t first = 0; first < block.count; first += kLanes) {
        float sum[kLanes] = {};
        for (size_t lane = 0; lane < kLanes; ++lane)
            asked[0][lane] = first + lane < block.count ? 1.0f : 0.0f;
        for (uint32_t j = 0; j < patches;) {
            const size_t depth = lamp.depth[j];
            if (isAsked[depth] == 0) {
                j = lamp.after[j];
                continue;
            }
            const float* own = asked[depth];
            float* parts = asked[depth + 1];
            uint32_t any = 0;
            const glm::vec3 middle(lamp.x[j], lamp.y[j], lamp.z[j]);
            const glm::vec3 facing(lamp.nx[j], lamp.ny[j], lamp.nz[j]);
            const float leaf = lamp.after[j] > j + 1 ? 0.0f : 1.0f;
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way = middle - glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                const float share =
                    shareOfParts(dot(way, way), lamp.farSquared[j], lamp.perRamp[j]);
                const float wide = wideFormFactor(way, normal, facing, lamp.spread[j]);
                const float near = leaf * nearFormFactor(way, normal, facing, lamp.area[j]);
                float factor = wide + share * (near - wide);
                if constexpr (geometry == Geometry::scanned)
                    factor *= shareBeyondMeshNoise(way, normal, facing);
                sum[lane] += own[lane] * lamp.area[j] * factor;
                parts[lane] = own[lane] * share;
                any |= parts[lane] > 0.0f ? 1u : 0u;
            }
            isAsked[depth + 1] = any;
            ++j;
        }
        std::copy_n(sum, kLanes, args.irradiance + first);
    }
}

} // namespace

LampPatches::LampPatches(const AreaLight& light)
{
    Planter(light.patches(), *this).plant();
}

void openIrradiance(const TexelBlock& block, const LampPatches& lamp, Geometry geometry,
                    float* irradiance, InstructionSet set)
{
    const OpenArgs args{&block, &lamp, irradiance};
    if (geometry == Geometry::scanned)
        runKernel<openKernel<Geometry::scanned>>(set, args);
    else
        runKernel<openKernel<Geometry::exact>>(set, args);
}

} // namespace relamp
