#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace relamp
{

/// A row of values of which most are `Value{}`. Blocks of nothing else are not kept: of a house,
/// what one lamp does takes the memory that its own room needs. Copies share what they hold.
template<class Value>
class SparseBlocks
{
public:
    static constexpr size_t kBlock = 64; // values that follow each other

    SparseBlocks() = default;
    explicit SparseBlocks(size_t count) : count_(count), blocks_((count + kBlock - 1) / kBlock) {}
    explicit SparseBlocks(std::span<const Value> values) : SparseBlocks(values.size())
    {
        for (size_t b = 0; b < blocks_.size(); ++b)
            put(b * kBlock, values.subspan(b * kBlock, std::min(kBlock, count_ - b * kBlock)));
    }

    [[nodiscard]] size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    Value operator[](size_t i) const
    {
        const std::shared_ptr<Block>& block = blocks_[i / kBlock];
        return block ? (*block)[i % kBlock] : Value{};
    }
    /// The values from `first` on, which a block begins with, as many as it has at most. Threads
    /// may put blocks at once, each its own.
    void put(size_t first, std::span<const Value> values)
    {
        if (std::all_of(values.begin(), values.end(), [](Value value) { return value == Value{}; }))
            return;
        auto block = std::make_shared<Block>();
        std::ranges::copy(values, block->begin());
        blocks_[first / kBlock] = std::move(block);
    }
    /// Copies of this keep what they have.
    void set(size_t i, Value value)
    {
        std::shared_ptr<Block>& block = blocks_[i / kBlock];
        if (!block) block = std::make_shared<Block>();
        if (block.use_count() > 1) block = std::make_shared<Block>(*block);
        (*block)[i % kBlock] = value;
    }
    /// Adds as many others, value by value.
    void add(const SparseBlocks& others)
    {
        for (size_t b = 0; b < blocks_.size(); ++b) {
            if (!others.blocks_[b]) continue;
            if (!blocks_[b]) {
                blocks_[b] = others.blocks_[b];
                continue;
            }
            auto sum = std::make_shared<Block>(*blocks_[b]);
            for (size_t i = 0; i < kBlock; ++i) (*sum)[i] += (*others.blocks_[b])[i];
            blocks_[b] = std::move(sum);
        }
    }

    [[nodiscard]] size_t blocks() const { return blocks_.size(); }
    /// Calls `f(i, value)` for all values of a block that is kept.
    template<class F>
    void forEachOf(size_t block, const F& f) const
    {
        if (!blocks_[block]) return;
        const size_t first = block * kBlock;
        const size_t count = std::min(kBlock, count_ - first);
        for (size_t i = 0; i < count; ++i) f(first + i, (*blocks_[block])[i]);
    }

private:
    using Block = std::array<Value, kBlock>;

    size_t count_ = 0;
    std::vector<std::shared_ptr<Block>> blocks_; // null: all are Value{}
};

} // namespace relamp
