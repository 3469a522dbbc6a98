#pragma once

#include "base/instruction_set.h"
#include "base/sparse_blocks.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"
#include "scan/texels.h"
#include "shading/lamp_sight.h"
#include "shading/seen.h"
#include "shading/visibility.shared.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

struct VisibilityOptions
{
    size_t raysPerProbe = 8; // >= 1
    InstructionSet set = bestInstructionSet();
};

/// What share of every lamp each place of the scan sees.
///
/// Rays go where the answer changes: a surfel that sees all of a lamp, or nothing, as its
/// neighbours do, needs no more than to say so. In the others a few texels look for themselves
/// (probes), all of them where there are few, and the rest lie between.
class Visibility
{
public:
    /// `coarse[lamp][surfel]` is what a few rays of each surfel's front saw. The arguments must
    /// outlive this.
    Visibility(const Texels& texels, const RayScene& scene, std::span<const AreaLight> lamps,
               std::span<const LampSight> coarse, const VisibilityOptions& options);

    /// One more lamp, which comes last; `scene` is what stands before it. `openShare[surfel]`,
    /// where it is known: what the lamp would bring with nothing in the way, of all the light
    /// there; the more that is, and the less surfels around agree in `coarse`, the more rays.
    /// Texels that `inShade` marks, if there are such marks, see nothing of it.
    void add(const RayScene& scene, const AreaLight& lamp, const LampSight& coarse,
             size_t raysPerProbe, std::span<const float> openShare = {},
             const TexelMarks& inShade = {});

    /// Share, 0..1, of a lamp that texels [first, end) of a block see, all of one surfel. May write
    /// up to a group of lanes behind `end`.
    void at(size_t lamp, uint32_t surfel, const TexelBlock& block, size_t first, size_t end,
            float* share) const;

    /// Whether any of the surfels [begin, end), or one around these, sees something of a lamp.
    [[nodiscard]] bool isSeen(size_t lamp, size_t begin, size_t end) const;

    /// Where probes are, and how far the word of each surfel's goes.
    struct Probes
    {
        std::span<const uint32_t> first; // of surfels, and one more
        std::span<const float> x, y, z;
        std::span<const float> reach; // of surfels, m
    };
    [[nodiscard]] Probes probes() const { return {firstProbe_, x_, y_, z_, reach_}; }
    /// What a surfel and those around it see of a lamp.
    [[nodiscard]] Seen seen(size_t lamp, uint32_t surfel) const { return states_[lamp][surfel]; }
    /// What each probe sees of a lamp, of kShareOfAll; or kShareUnknown.
    [[nodiscard]] std::vector<uint8_t> sharesOf(size_t lamp) const;

private:
    /// What probes see of a lamp: by blocks of surfels, which hold nothing where none looked.
    using Shares = std::vector<std::vector<uint8_t>>;

    void placeProbes();
    [[nodiscard]] Shares look(const AreaLight& lamp, std::span<const Seen> states,
                              const RayScene& scene, std::span<const uint32_t> rays) const;
    void darken(const TexelMarks& inShade, Shares& shares) const;
    void drawTogether(std::span<const Seen> states, std::span<const uint32_t> rays,
                      Shares& shares) const;
    /// Of a surfel's probes; empty where its block holds nothing.
    template<class AnyShares>
    [[nodiscard]] auto ofSurfel(AnyShares& shares, uint32_t surfel) const;

    const Texels& texels_;
    SurfelSites sites_;
    InstructionSet set_;
    std::vector<uint32_t> firstProbe_;       // of surfels, and one more
    std::vector<float> x_, y_, z_;           // of probes
    std::vector<float> reach_;               // of surfels, m: how far a probe's word goes
    std::vector<SparseBlocks<Seen>> states_; // [lamp][surfel]
    std::vector<Shares> shares_;             // of lamps, of kAll; kUnknown: faces away
};

} // namespace relamp
