#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace relamp
{

/// A row of values of which most are `Value{}`. Blocks of nothing else are not kept, nor is the
/// place of a block where none around it is: of a house, what one lamp does takes the memory that
/// its own room needs. Copies share what they hold; one thread at a time changes any of them.
template<class Value>
class SparseBlocks
{
public:
    static constexpr size_t kBlock = 64; // values that follow each other
    using Block = std::array<Value, kBlock>;
    using Kept = std::shared_ptr<Block>; // null: all are Value{}

    SparseBlocks() = default;
    explicit SparseBlocks(size_t count)
        : count_(count), chapters_((blocks() + kBlocks - 1) / kBlocks)
    {}
    explicit SparseBlocks(std::span<const Value> values) : SparseBlocks(values.size())
    {
        for (size_t b = 0; b < blocks(); ++b)
            put(b, kept(values.subspan(b * kBlock, std::min(kBlock, count_ - b * kBlock))));
    }

    [[nodiscard]] size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    Value operator[](size_t i) const
    {
        const Block* const block = find(i / kBlock);
        return block != nullptr ? (*block)[i % kBlock] : Value{};
    }
    /// At most a block of values, as put() takes them.
    static Kept kept(std::span<const Value> values)
    {
        assert(values.size() <= kBlock);
        if (std::ranges::all_of(values, [](Value value) { return value == Value{}; })) return {};
        auto block = std::make_shared<Block>();
        std::ranges::copy(values, block->begin());
        return block;
    }
    /// In a place where nothing is yet. Copies of this keep what they have, here and below.
    void put(size_t block, Kept values)
    {
        assert(find(block) == nullptr);
        if (values) placeOf(block) = std::move(values);
    }
    void set(size_t i, Value value)
    {
        Kept& block = placeOf(i / kBlock);
        if (!block) block = std::make_shared<Block>();
        if (block.use_count() > 1) block = std::make_shared<Block>(*block);
        (*block)[i % kBlock] = value;
    }
    /// Adds as many others, value by value.
    void add(const SparseBlocks& others)
    {
        assert(others.size() == size());
        for (size_t b = 0; b < blocks(); ++b) {
            if (others.find(b) == nullptr) continue;
            const Kept more = (*others.chapters_[b / kBlocks])[b % kBlocks];
            Kept& block = placeOf(b);
            if (!block) {
                block = more;
                continue;
            }
            auto sum = std::make_shared<Block>(*block);
            for (size_t i = 0; i < kBlock; ++i) (*sum)[i] += (*more)[i];
            block = std::move(sum);
        }
    }

    [[nodiscard]] size_t blocks() const { return (count_ + kBlock - 1) / kBlock; }
    /// Calls `f(i, value)` for all values of a block that is kept.
    template<class F>
    void forEachOf(size_t block, const F& f) const
    {
        const Block* const values = find(block);
        if (values == nullptr) return;
        const size_t first = block * kBlock;
        const size_t count = std::min(kBlock, count_ - first);
        for (size_t i = 0; i < count; ++i) f(first + i, (*values)[i]);
    }

private:
    static constexpr size_t kBlocks = 64; // of a chapter
    using Chapter = std::array<Kept, kBlocks>;

    [[nodiscard]] const Block* find(size_t block) const
    {
        const std::shared_ptr<Chapter>& chapter = chapters_[block / kBlocks];
        return chapter ? (*chapter)[block % kBlocks].get() : nullptr;
    }
    /// In a chapter of its own.
    Kept& placeOf(size_t block)
    {
        std::shared_ptr<Chapter>& chapter = chapters_[block / kBlocks];
        if (!chapter) chapter = std::make_shared<Chapter>();
        if (chapter.use_count() > 1) chapter = std::make_shared<Chapter>(*chapter);
        return (*chapter)[block % kBlocks];
    }

    size_t count_ = 0;
    std::vector<std::shared_ptr<Chapter>> chapters_; // null: all are Value{}
};

} // namespace relamp
