#include "fit/squares.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kTogether = 8; // residuals, so that a sum is loaded and stored once for all
constexpr size_t kColumns = 4;  // likewise, so that a row is loaded once for all

struct SquaresArgs
{
    const PlaceTable* table;
    const float* factor;
    const PairResidual* residuals;
    size_t count;
    float* rows;    // kTogether * stride, room to work in
    size_t* groups; // stride / kLanes + 1, likewise
    size_t* inUse;  // stride, likewise
    float* sums;    // stride * stride; what lies above the diagonal's group counts for nothing
};

void putRows(const SquaresArgs& args, size_t first)
{
    const PlaceTable& table = *args.table;
    const size_t count = std::min(kTogether, args.count - first);
    std::fill_n(args.rows, kTogether * table.stride(), 0.0f);
    for (size_t k = 0; k < count; ++k) {
        const PairResidual& residual = args.residuals[first + k];
        const float* p = table.row(residual.pair.p);
        const float* q = table.row(residual.pair.q);
        const float timesP = residual.slope * args.factor[residual.pair.p];
        const float timesQ = residual.slope * args.factor[residual.pair.q];
        float* row = args.rows + k * table.stride();
        RELAMP_INDEPENDENT_ITERATIONS
        for (size_t f = 0; f < table.scaled(); ++f) row[f] = timesQ * q[f] - timesP * p[f];
        RELAMP_INDEPENDENT_ITERATIONS
        for (size_t f = table.scaled(); f < table.columns(); ++f)
            row[f] = residual.slope * (q[f] - p[f]);
        row[table.columns()] = residual.value;
    }
}

/// Groups of lanes and columns in which a row has something: a place knows few of a lattice's
/// knots. The stride ends the groups. Returns how many columns there are.
size_t findColumns(const SquaresArgs& args)
{
    const size_t stride = args.table->stride();
    size_t* group = args.groups;
    size_t count = 0;
    for (size_t j = 0; j < stride; j += kLanes) {
        float sum[kLanes] = {};
        for (size_t k = 0; k < kTogether; ++k) {
            const float* row = args.rows + k * stride + j;
            RELAMP_KEEP_LOOP
            for (size_t lane = 0; lane < kLanes; ++lane) sum[lane] += std::abs(row[lane]);
        }
        const size_t before = count;
        for (size_t lane = 0; lane < kLanes; ++lane)
            if (sum[lane] > 0.0f) args.inUse[count++] = j + lane;
        if (count > before) *group++ = j;
    }
    *group = stride;
    return count;
}

/// The products of `n` columns with all that come before them.
template<size_t n>
void addProducts(const SquaresArgs& args, const size_t* column)
{
    const size_t stride = args.table->stride();
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
    }
}

} // namespace

std::vector<double> squaresOf(const PlaceTable& table, std::span<const float> factor,
                              std::span<const PairResidual> residuals, InstructionSet set)
{
    const size_t stride = table.stride();
    std::vector<std::vector<float>> ofChunk((residuals.size() + kPairsOfChunk - 1) / kPairsOfChunk);
    forEachChunk(residuals.size(), kPairsOfChunk, [&](size_t begin, size_t end) {
        std::vector<float> rows(kTogether * stride);
        std::vector<size_t> groups(stride / kLanes + 1);
        std::vector<size_t> inUse(stride);
        std::vector<float>& sums = ofChunk[begin / kPairsOfChunk];
        sums.assign(stride * stride, 0.0f);
        const SquaresArgs args{&table,      factor.data(), &residuals[begin], end - begin,
                               rows.data(), groups.data(), inUse.data(),      sums.data()};
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

} // namespace relamp
