#include "fit/squares.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::Pointwise;

constexpr size_t kSquarePlaces = 50;

using Table = std::vector<std::vector<float>>; // of places

Table tableOf(size_t columns)
{
    std::mt19937 random(3);
    Table table(kSquarePlaces, std::vector<float>(columns));
    for (std::vector<float>& row : table)
        for (float& value : row)
            value = random() % 4 == 0 ? static_cast<float>(random() % 1000) / 1000.0f : 0.0f;
    return table;
}

PackedRows packed(const Table& table)
{
    return {table.size(), table.front().size(),
            [&](size_t i, std::span<float> row) { std::ranges::copy(table[i], row.begin()); }};
}

std::vector<float> factors()
{
    std::mt19937 random(5);
    std::vector<float> factor;
    for (size_t place = 0; place < kSquarePlaces; ++place)
        factor.push_back(static_cast<float>(random() % 100) / 50.0f);
    return factor;
}

std::vector<PairResidual> residualsOf(size_t count)
{
    std::mt19937 random(4);
    std::vector<PairResidual> residuals;
    for (size_t i = 0; i < count; ++i)
        residuals.push_back({{static_cast<uint32_t>(random() % kSquarePlaces),
                              static_cast<uint32_t>(random() % kSquarePlaces)},
                             static_cast<float>(random() % 100) / 100.0f,
                             static_cast<float>(random() % 100) / 50.0f - 1.0f});
    return residuals;
}

std::vector<double> oneByOne(const Table& table, size_t scaled, const std::vector<float>& factor,
                             const std::vector<PairResidual>& residuals)
{
    const size_t size = table.front().size() + 1;
    std::vector<double> sum(size * size, 0.0);
    for (const auto& [pair, slope, value] : residuals) {
        std::vector<double> v;
        for (size_t f = 0; f + 1 < size; ++f)
            v.push_back(static_cast<double>(
                slope * ((f < scaled ? factor[pair.q] : 1.0f) * table[pair.q][f] -
                         (f < scaled ? factor[pair.p] : 1.0f) * table[pair.p][f])));
        v.push_back(static_cast<double>(value));
        for (size_t i = 0; i < size; ++i)
            for (size_t j = 0; j < size; ++j) sum[i * size + j] += v[i] * v[j];
    }
    return sum;
}

// Whatever remains when residuals are taken eight at a time, columns sixteen and four, and chunks
// 2048; most entries are 0, so that columns and whole groups of them are passed over.
TEST(Squares, AreThoseOfEveryResidualByItself)
{
    const std::vector<float> factor = factors();
    for (const size_t columns : {1u, 15u, 16u, 40u, 90u})
        for (const size_t count : {1u, 8u, 3001u}) {
            const size_t scaled = columns / 2;
            const Table table = tableOf(columns);
            const auto residuals = residualsOf(count);
            const std::vector<double> expected = oneByOne(table, scaled, factor, residuals);
            for (const auto set :
                 {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
                if (set > bestInstructionSet()) continue;
                EXPECT_THAT(squaresOf(packed(table), scaled, factor, residuals, set),
                            Pointwise(DoubleNear(1e-5 * expected.back()), expected));
            }
        }
}

TEST(Squares, RowsAreSummedTimesTheirFactors)
{
    const std::vector<float> factor = factors();
    const Table table = tableOf(40);
    std::vector<double> expected(40, 0.0);
    for (size_t i = 0; i < 30; ++i)
        for (size_t j = 0; j < expected.size(); ++j)
            expected[j] += static_cast<double>((j < 20 ? factor[i] : 1.0f) * table[i][j]);
    EXPECT_THAT(sumOf(packed(table), 20, std::span(factor).first(30)),
                Pointwise(DoubleNear(1e-4), expected));
}

TEST(Squares, OfNothingAreNothing)
{
    EXPECT_THAT(squaresOf(packed(tableOf(3)), 1, factors(), {}), Each(0.0));
}

} // namespace
} // namespace relamp
