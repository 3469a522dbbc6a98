#pragma once

#include "shading/area_direct.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace relamp
{

/// What numbered places see of one lamp. Where a block of them sees nothing of it, nothing is kept:
/// of a house each lamp takes the memory that its own room needs. Copies share what they hold.
class LampSight
{
public:
    static constexpr size_t kBlock = 64; // places that follow each other

    LampSight() = default;
    /// By `count` places, so far of none.
    explicit LampSight(size_t count) : count_(count), blocks_((count + kBlock - 1) / kBlock) {}
    explicit LampSight(std::span<const AreaSample> seen) : LampSight(seen.size())
    {
        for (size_t b = 0; b < blocks_.size(); ++b)
            put(b * kBlock, seen.subspan(b * kBlock, std::min(kBlock, count_ - b * kBlock)));
    }

    [[nodiscard]] size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    AreaSample operator[](size_t place) const
    {
        const std::shared_ptr<Block>& block = blocks_[place / kBlock];
        return block ? (*block)[place % kBlock] : AreaSample{};
    }
    /// What places from `first` on see, which a block begins with, as many as it has at most.
    /// Threads may put blocks at once, each its own.
    void put(size_t first, std::span<const AreaSample> seen)
    {
        if (std::all_of(seen.begin(), seen.end(), [](AreaSample s) { return s.open <= 0.0f; }))
            return;
        auto block = std::make_shared<Block>();
        std::ranges::copy(seen, block->begin());
        blocks_[first / kBlock] = std::move(block);
    }
    /// Another sight of one place; copies of this keep theirs.
    void set(size_t place, AreaSample seen)
    {
        std::shared_ptr<Block>& block = blocks_[place / kBlock];
        block = block ? std::make_shared<Block>(*block) : std::make_shared<Block>();
        (*block)[place % kBlock] = seen;
    }

    /// As if it were both lamps, of as many places.
    void add(const LampSight& other)
    {
        for (size_t b = 0; b < blocks_.size(); ++b) {
            if (!other.blocks_[b]) continue;
            if (!blocks_[b]) {
                blocks_[b] = other.blocks_[b];
                continue;
            }
            auto sum = std::make_shared<Block>(*blocks_[b]);
            for (size_t i = 0; i < kBlock; ++i) {
                (*sum)[i].open += (*other.blocks_[b])[i].open;
                (*sum)[i].visible += (*other.blocks_[b])[i].visible;
            }
            blocks_[b] = std::move(sum);
        }
    }

    [[nodiscard]] size_t blocks() const { return blocks_.size(); }
    /// Calls `f(place, sample)` for the places of a block, if any of them sees something.
    template<class F>
    void forEachOf(size_t block, const F& f) const
    {
        if (!blocks_[block]) return;
        const size_t first = block * kBlock;
        const size_t count = std::min(kBlock, count_ - first);
        for (size_t i = 0; i < count; ++i) f(first + i, (*blocks_[block])[i]);
    }

private:
    using Block = std::array<AreaSample, kBlock>;

    size_t count_ = 0;
    std::vector<std::shared_ptr<Block>> blocks_; // null: nothing is seen
};

} // namespace relamp
