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

PlaceTable tableOf(size_t columns, size_t scaled)
{
    std::mt19937 random(3);
    PlaceTable table(kSquarePlaces, scaled, columns);
    for (size_t place = 0; place < kSquarePlaces; ++place)
        for (size_t f = 0; f < columns; ++f)
            table.row(place)[f] =
                random() % 4 == 0 ? static_cast<float>(random() % 1000) / 1000.0f : 0.0f;
    return table;
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

std::vector<double> oneByOne(const PlaceTable& table, const std::vector<float>& factor,
                             const std::vector<PairResidual>& residuals)
{
    const size_t size = table.columns() + 1;
    std::vector<double> sum(size * size, 0.0);
    for (const auto& [pair, slope, value] : residuals) {
        std::vector<double> v;
        for (size_t f = 0; f < table.columns(); ++f)
            v.push_back(static_cast<double>(
                slope * ((f < table.scaled() ? factor[pair.q] : 1.0f) * table.row(pair.q)[f] -
                         (f < table.scaled() ? factor[pair.p] : 1.0f) * table.row(pair.p)[f])));
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
            const PlaceTable table = tableOf(columns, columns / 2);
            const auto residuals = residualsOf(count);
            const std::vector<double> expected = oneByOne(table, factor, residuals);
            for (const auto set :
                 {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
                if (set > bestInstructionSet()) continue;
                EXPECT_THAT(squaresOf(table, factor, residuals, set),
                            Pointwise(DoubleNear(1e-5 * expected.back()), expected));
            }
        }
}

TEST(Squares, OfNothingAreNothing)
{
    EXPECT_THAT(squaresOf(tableOf(3, 1), factors(), {}), Each(0.0));
}

} // namespace
} // namespace relamp
