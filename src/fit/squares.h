#pragma once

#include "base/instruction_set.h"
#include "base/lanes.h"
#include "fit/light_model.h"

#include <cstddef>
#include <span>
#include <vector>

namespace relamp
{

/// A row of numbers a place, each padded by zeros to whole groups of lanes. The first of them are
/// meant times a factor of the place's own.
class PlaceTable
{
public:
    PlaceTable(size_t places, size_t scaled, size_t columns)
        : scaled_(scaled), columns_(columns), stride_(paddedToLanes(columns + 1)),
          values_(places * stride_, 0.0f)
    {}

    [[nodiscard]] float* row(size_t place) { return &values_[place * stride_]; }
    [[nodiscard]] const float* row(size_t place) const { return &values_[place * stride_]; }
    [[nodiscard]] size_t scaled() const { return scaled_; } // columns, the first
    [[nodiscard]] size_t columns() const { return columns_; }
    [[nodiscard]] size_t stride() const { return stride_; } // > columns

private:
    size_t scaled_;
    size_t columns_;
    size_t stride_;
    std::vector<float> values_;
};

// Numerics.
inline constexpr size_t kPairsOfChunk = 2048; // that one thread sums

/// The residual of two places; its Jacobian is slope * (row of q - row of p), rows scaled.
struct PairResidual
{
    MaterialPair pair;
    float slope;
    float value;
};

/// All that least squares need to know of many residuals r with the Jacobian J: the sum of v v^T of
/// v = (row of J, r), row after row, columns + 1 square. `factor`: of places. The same on any
/// number of threads.
std::vector<double> squaresOf(const PlaceTable& table, std::span<const float> factor,
                              std::span<const PairResidual> residuals,
                              InstructionSet set = bestInstructionSet());

} // namespace relamp
