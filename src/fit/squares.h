#pragma once

#include "base/instruction_set.h"
#include "fit/light_model.h"
#include "fit/packed_rows.h"

#include <cstddef>
#include <span>
#include <vector>

namespace relamp
{

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
/// v = (row of J, r), row after row, columns + 1 square. `factor`: of places; of a row of `table`
/// the first `scaled` columns are meant times that. The same on any number of threads.
std::vector<double> squaresOf(const PackedRows& table, size_t scaled, std::span<const float> factor,
                              std::span<const PairResidual> residuals,
                              InstructionSet set = bestInstructionSet());

/// The sum of the first rows, scaled by as many factors.
std::vector<double> sumOf(const PackedRows& table, size_t scaled, std::span<const float> factor,
                          InstructionSet set = bestInstructionSet());

} // namespace relamp
