#include "fit/squares.h"

#include "base/parallel.h"

#include <algorithm>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kTogether = 8; // residuals, so that a sum is loaded and stored once for all

struct SquaresArgs
{
    const PlaceTable* table;
    const PairResidual* residuals;
    size_t count;
    float* rows; // kTogether * stride, room to work in
    float* sums; // stride * stride; what lies above the diagonal's group counts for nothing
};

void putRows(const SquaresArgs& args, size_t first)
{
    const size_t stride = args.table->stride();
    const size_t count = std::min(kTogether, args.count - first);
    std::fill_n(args.rows, kTogether * stride, 0.0f);
    for (size_t k = 0; k < count; ++k) {
        const PairResidual& residual = args.residuals[first + k];
        const float* p = args.table->row(residual.pair.p);
        const float* q = args.table->row(residual.pair.q);
        float* row = args.rows + k * stride;
        RELAMP_INDEPENDENT_ITERATIONS
        for (size_t f = 0; f < stride; ++f) row[f] = residual.slope * (q[f] - p[f]);
        row[args.table->columns()] = residual.value;
    }
}

void squaresKernel(const SquaresArgs& args)
{
    const size_t stride = args.table->stride();
    for (size_t first = 0; first < args.count; first += kTogether) {
        putRows(args, first);
        for (size_t i = 0; i <= args.table->columns(); ++i)
            for (size_t j = 0; j <= i; j += kLanes) {
                float* sums = args.sums + i * stride + j;
                float sum[kLanes];
                RELAMP_KEEP_LOOP
                for (size_t lane = 0; lane < kLanes; ++lane) sum[lane] = sums[lane];
                for (size_t k = 0; k < kTogether; ++k) {
                    const float* row = args.rows + k * stride;
                    RELAMP_KEEP_LOOP
                    for (size_t lane = 0; lane < kLanes; ++lane)
                        sum[lane] += row[i] * row[j + lane];
                }
                RELAMP_KEEP_LOOP
                for (size_t lane = 0; lane < kLanes; ++lane) sums[lane] = sum[lane];
            }
    }
}

} // namespace

std::vector<double> squaresOf(const PlaceTable& table, std::span<const PairResidual> residuals,
                              InstructionSet set)
{
    const size_t stride = table.stride();
    std::vector<std::vector<float>> ofChunk((residuals.size() + kPairsOfChunk - 1) / kPairsOfChunk);
    forEachChunk(residuals.size(), kPairsOfChunk, [&](size_t begin, size_t end) {
        std::vector<float> rows(kTogether * stride);
        std::vector<float>& sums = ofChunk[begin / kPairsOfChunk];
        sums.assign(stride * stride, 0.0f);
        const SquaresArgs args{&table, &residuals[begin], end - begin, rows.data(), sums.data()};
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
