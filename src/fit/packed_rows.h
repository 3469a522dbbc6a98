#pragma once

#include "base/lanes.h"
#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Rows of numbers, of which groups of lanes that are 0 are left out: a place of a house knows the
/// lamps of its own room.
class PackedRows
{
public:
    /// `fill(row, numbers)` is called once for each of `rows`, by all threads, with `columns`
    /// zeros.
    template<class Fill>
    PackedRows(size_t rows, size_t columns, const Fill& fill)
        : columns_(columns), chunks_((rows + kRows - 1) / kRows)
    {
        forEachChunk(rows, kRows, [&](size_t begin, size_t end) {
            std::vector<float> row(paddedToLanes(columns));
            Chunk& chunk = chunks_[begin / kRows];
            chunk.first.reserve(end - begin + 1);
            for (size_t i = begin; i < end; ++i) {
                std::fill(row.begin(), row.end(), 0.0f);
                fill(i, std::span(row).first(columns));
                chunk.append(row);
            }
        });
    }

    struct Row
    {
        std::span<const uint16_t> groups; // of columns, ascending: from group * kLanes on
        const float* values;              // kLanes a group
    };
    [[nodiscard]] Row row(size_t i) const { return chunks_[i / kRows].row(i % kRows); }
    [[nodiscard]] size_t columns() const { return columns_; }
    /// The numbers that a row has in some columns, ascending.
    void pick(size_t i, std::span<const size_t> columns, std::span<float> numbers) const
    {
        const Row of = row(i);
        size_t k = 0;
        for (size_t g = 0; g < of.groups.size(); ++g) {
            const size_t first = of.groups[g] * kLanes;
            for (; k < columns.size() && columns[k] < first; ++k) numbers[k] = 0.0f;
            for (; k < columns.size() && columns[k] < first + kLanes; ++k)
                numbers[k] = of.values[g * kLanes + columns[k] - first];
        }
        std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(k),
                  numbers.begin() + static_cast<std::ptrdiff_t>(columns.size()), 0.0f);
    }

private:
    // Numerics.
    static constexpr size_t kRows = 256; // of a chunk

    struct Chunk
    {
        std::vector<uint32_t> first{0}; // group of each row, and one more
        std::vector<uint16_t> groups;
        std::vector<float> values;

        void append(std::span<const float> row)
        {
            for (size_t j = 0; j < row.size(); j += kLanes) {
                int isAny = 0;
                for (size_t lane = 0; lane < kLanes; ++lane) isAny |= row[j + lane] != 0.0f ? 1 : 0;
                if (isAny == 0) continue;
                groups.push_back(static_cast<uint16_t>(j / kLanes));
                const auto group = row.begin() + static_cast<std::ptrdiff_t>(j);
                values.insert(values.end(), group, group + kLanes);
            }
            first.push_back(static_cast<uint32_t>(groups.size()));
        }
        [[nodiscard]] Row row(size_t i) const
        {
            return {std::span(groups).subspan(first[i], first[i + 1] - first[i]),
                    values.data() + first[i] * kLanes};
        }
    };

    size_t columns_;
    std::vector<Chunk> chunks_;
};

} // namespace relamp
