#include "base/sparse_blocks.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Sparse = SparseBlocks<float>;

constexpr size_t kSparseValues = 3 * Sparse::kBlock - 10; // the last block is not full

/// Of the middle block alone, each as much as its number.
Sparse middleBlock()
{
    std::vector<float> values(kSparseValues, 0.0f);
    for (size_t i = Sparse::kBlock; i < 2 * Sparse::kBlock; ++i) values[i] = static_cast<float>(i);
    return Sparse(values);
}

size_t valuesKept(const Sparse& values)
{
    size_t kept = 0;
    for (size_t b = 0; b < values.blocks(); ++b)
        values.forEachOf(b, [&](size_t, float) { ++kept; });
    return kept;
}

} // namespace

TEST(SparseBlocks, KeepThoseThatHoldSomething)
{
    const Sparse middle = middleBlock();
    EXPECT_EQ(middle.size(), kSparseValues);
    EXPECT_EQ(valuesKept(middle), Sparse::kBlock);
    EXPECT_EQ(middle[Sparse::kBlock - 1], 0.0f);
    EXPECT_EQ(middle[Sparse::kBlock + 3], 67.0f);
    EXPECT_EQ(middle[kSparseValues - 1], 0.0f);
}

TEST(SparseBlocks, ChangeNoCopyOfThem)
{
    Sparse values = middleBlock();
    const Sparse copy = values;
    values.set(Sparse::kBlock, 1.0f);
    values.set(kSparseValues - 1, 2.0f); // of a block that held nothing
    EXPECT_EQ(values[Sparse::kBlock], 1.0f);
    EXPECT_EQ(values[kSparseValues - 1], 2.0f);
    EXPECT_EQ(valuesKept(values), 2 * Sparse::kBlock - 10);
    EXPECT_EQ(copy[Sparse::kBlock], 64.0f);
    EXPECT_EQ(copy[kSparseValues - 1], 0.0f);
}

// A lamp of a house of many rooms.
TEST(SparseBlocks, OfALongRowAreWhereTheyWerePut)
{
    constexpr size_t kFar = 100'000;
    Sparse values(2 * kFar);
    values.set(kFar, 3.0f);
    Sparse copy = values;
    copy.put(kFar / Sparse::kBlock + 1, Sparse::kept(std::vector<float>(Sparse::kBlock, 5.0f)));
    copy.set(2 * kFar - 1, 7.0f);
    EXPECT_EQ(valuesKept(values), Sparse::kBlock);
    EXPECT_EQ(valuesKept(copy), 3 * Sparse::kBlock);
    values.add(copy);
    EXPECT_EQ(values[kFar], 6.0f);
    EXPECT_EQ(values[kFar + Sparse::kBlock], 5.0f);
    EXPECT_EQ(values[2 * kFar - 1], 7.0f);
    EXPECT_EQ(values[0], 0.0f);
    EXPECT_EQ(copy[kFar], 3.0f);
    EXPECT_EQ(Sparse::kept(std::vector<float>(4, 0.0f)), nullptr);
}

TEST(SparseBlocks, AddValueByValue)
{
    Sparse both = middleBlock();
    Sparse others(kSparseValues);
    others.set(0, 3.0f);
    others.set(Sparse::kBlock, 6.0f);
    both.add(others);
    EXPECT_EQ(both[0], 3.0f);
    EXPECT_EQ(both[Sparse::kBlock], 70.0f);
    EXPECT_EQ(both[Sparse::kBlock + 1], 65.0f);
    EXPECT_EQ(others[Sparse::kBlock], 6.0f);
}

} // namespace relamp
