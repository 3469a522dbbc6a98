#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

/// Calls visit(row) for rows 0 .. rows - 1 from as many threads as there are cores. `visit` throws
/// nothing.
template<class Visit>
void forEachRow(size_t rows, const Visit& visit)
{
    constexpr size_t kRowsAtOnce = 16;
    std::atomic<size_t> next{0};
    const auto work = [&] {
        for (size_t begin = next.fetch_add(kRowsAtOnce); begin < rows;
             begin = next.fetch_add(kRowsAtOnce))
            for (size_t row = begin; row < std::min(begin + kRowsAtOnce, rows); ++row) visit(row);
    };
    std::vector<std::jthread> others;
    const size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
    for (size_t i = 1; i < std::min(cores, rows / kRowsAtOnce + 1); ++i) others.emplace_back(work);
    work();
}
