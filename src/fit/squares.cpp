#include "fit/squares.h"

#include "base/lanes.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kTogether = 8;      // residuals, so that a sum is loaded and stored once for all
constexpr size_t kColumns = 4;       // likewise, so that a row is loaded once for all
constexpr size_t kRowsOfChunk = 256; // that one thread sums

/// Adds `times` of a row, and `more` times that of its columns that are scaled. `isScaled`: 1 or 0.
void addRow(const PackedRows::Row& row, const float* isScaled, float times, float more, float* sum)
{
    const float* values = row.values;
    for (const size_t group : row.groups) {
        float* to = sum + group * kLanes;
        const float* scaled = isScaled + group * kLanes;
        float added[kLanes];
        RELAMP_KEEP_LOOP
        for (size_t lane = 0; lane < kLanes; ++lane)
            added[lane] = to[lane] + times * (1.0f + more * scaled[lane]) * values[lane];
        RELAMP_KEEP_LOOP
        for (size_t lane = 0; lane < kLanes; ++lane) to[lane] = added[lane];
        values += kLanes;
    }
}

struct SumArgs
{
    const PackedRows* table;
    const float* isScaled;
    const float* factor;
    size_t begin;
    size_t end;
    float* sum;
};

void sumKernel(const SumArgs& args)
{
    for (size_t i = args.begin; i < args.end; ++i)
        addRow(args.table->row(i), args.isScaled, 1.0f, args.factor[i] - 1.0f, args.sum);
}

std::vector<float> marksOf(size_t scaled, size_t columns)
{
    std::vector<float> isScaled(paddedToLanes(columns), 0.0f);
    std::fill_n(isScaled.begin(), scaled, 1.0f);
    return isScaled;
}

struct SquaresArgs
{
    const PackedRows* table;
    const float* isScaled; // of columns, padded to lanes
    const float* factor;
    const PairResidual* residuals;
    size_t count;
    size_t stride;  // > columns, of whole groups
    float* rows;    // kTogether * stride zeros, room to work in
    size_t* groups; // stride / kLanes + 1, likewise
    size_t* inUse;  // stride, likewise
    float* sums;    // stride * stride; what lies above the diagonal's group counts for nothing
};

void putRows(const SquaresArgs& args, size_t first)
{
    const size_t count = std::min(kTogether, args.count - first);
    for (size_t k = 0; k < count; ++k) {
        const PairResidual& residual = args.residuals[first + k];
        const auto [p, q] = residual.pair;
        float* row = args.rows + k * args.stride;
        addRow(args.table->row(q), args.isScaled, residual.slope, args.factor[q] - 1.0f, row);
        addRow(args.table->row(p), args.isScaled, -residual.slope, args.factor[p] - 1.0f, row);
        row[args.table->columns()] = residual.value;
    }
}

/// Groups of lanes and columns in which a row has something: a place knows few of a lattice's
/// knots. The stride ends the groups. Returns how many columns there are.
size_t findColumns(const SquaresArgs& args)
{
    size_t* group = args.groups;
    size_t count = 0;
    for (size_t j = 0; j < args.stride; j += kLanes) {
        float sum[kLanes] = {};
        for (size_t k = 0; k < kTogether; ++k) {
            const float* row = args.rows + k * args.stride + j;
            RELAMP_KEEP_LOOP
            for (size_t lane = 0; lane < kLanes; ++lane) sum[lane] += std::abs(row[lane]);
        }
        const size_t before = count;
        for (size_t lane = 0; lane < kLanes; ++lane)
            if (sum[lane] > 0.0f) args.inUse[count++] = j + lane;
        if (count > before) *group++ = j;
    }
    *group = args.stride;
    return count;
}

void clearRows(const SquaresArgs& args)
{
    for (size_t k = 0; k < kTogether; ++k)
        for (const size_t* group = args.groups; *group < args.stride; ++group)
            std::fill_n(args.rows + k * args.stride + *group, kLanes, 0.0f);
}

/// The products of `n` columns with all that come before them.
template<size_t n>
void addProducts(const SquaresArgs& args, const size_t* column)
{
    const size_t stride = args.stride;
    for (const size_t* group = args.groups; *group <= column[n - 1]; ++group) {
        float sum[n][kLanes];
        for (size_t i = 0; i < n; ++i) {
            RELAMP_KEEP_LOOP
            for (size_t lane = 0; lane < kLanes; ++lane)
                sum[i][lane] = args.sums[column[i] * stride + *group + lane];
        }
        for (size_t k = 0; k < kTogether; ++k) {
            const float* row = args.rows + k * stride;
            for (size_t i = 0; i < n; ++i) {
                RELAMP_KEEP_LOOP
                for (size_t lane = 0; lane < kLanes; ++lane)
                    sum[i][lane] += row[column[i]] * row[*group + lane];
            }
        }
        for (size_t i = 0; i < n; ++i) {
            RELAMP_KEEP_LOOP
            for (size_t lane = 0; lane < kLanes; ++lane)
                args.sums[column[i] * stride + *group + lane] = sum[i][lane];
        }
    }
}

void squaresKernel(const SquaresArgs& args)
{
    for (size_t first = 0; first < args.count; first += kTogether) {
        putRows(args, first);
        const size_t columns = findColumns(args);
        size_t i = 0;
        for (; i + kColumns <= columns; i += kColumns) addProducts<kColumns>(args, args.inUse + i);
        for (; i < columns; ++i) addProducts<1>(args, args.inUse + i);
        clearRows(args);
    }
}

} // namespace

std::vector<double> squaresOf(const PackedRows& table, size_t scaled, std::span<const float> factor,
                              std::span<const PairResidual> residuals, InstructionSet set)
{
    const size_t stride = paddedToLanes(table.columns() + 1);
    const std::vector<float> isScaled = marksOf(scaled, stride);
    std::vector<std::vector<float>> ofChunk((residuals.size() + kPairsOfChunk - 1) / kPairsOfChunk);
    forEachChunk(residuals.size(), kPairsOfChunk, [&](size_t begin, size_t end) {
        std::vector<float> rows(kTogether * stride);
        std::vector<size_t> groups(stride / kLanes + 1);
        std::vector<size_t> inUse(stride);
        std::vector<float>& sums = ofChunk[begin / kPairsOfChunk];
        sums.assign(stride * stride, 0.0f);
        const SquaresArgs args{.table = &table,
                               .isScaled = isScaled.data(),
                               .factor = factor.data(),
                               .residuals = &residuals[begin],
                               .count = end - begin,
                               .stride = stride,
                               .rows = rows.data(),
                               .groups = groups.data(),
                               .inUse = inUse.data(),
                               .sums = sums.data()};
        runKernel<squaresKernel>(set, args);
    });
    const size_t size = table.columns() + 1;
    std::vector<double> squares(size * size, 0.0);
    for (const std::vector<float>& sums : ofChunk)
        for (size_t i = 0; i < size; ++i)
            for (size_t j = 0; j <= i; ++j)
                squares[i * size + j] += static_cast<double>(sums[i * stride + j]);
    for (size_t i = 0; i < size; ++i)
        for (size_t j = 0; j < i; ++j) squares[j * size + i] = squares[i * size + j];
    return squares;
}

std::vector<double> sumOf(const PackedRows& table, size_t scaled, std::span<const float> factor,
                          InstructionSet set)
{
    const std::vector<float> isScaled = marksOf(scaled, table.columns());
    std::vector<std::vector<float>> ofChunk((factor.size() + kRowsOfChunk - 1) / kRowsOfChunk);
    forEachChunk(factor.size(), kRowsOfChunk, [&](size_t begin, size_t end) {
        std::vector<float>& sum = ofChunk[begin / kRowsOfChunk];
        sum.assign(isScaled.size(), 0.0f);
        const SumArgs args{&table, isScaled.data(), factor.data(), begin, end, sum.data()};
        runKernel<sumKernel>(set, args);
    });
    std::vector<double> sum(table.columns(), 0.0);
    for (const std::vector<float>& part : ofChunk)
        for (size_t j = 0; j < sum.size(); ++j) sum[j] += static_cast<double>(part[j]);
    return sum;
}

} // namespace relamp
