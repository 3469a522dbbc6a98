#pragma once

#include <array>
#include <cstddef>
#include <exception>

#include <tbb/parallel_invoke.h>

namespace relamp
{

/// Calls all functions beside each other, to their ends, and then throws what the first of them
/// threw. oneTBB by itself would cancel the loops within the others, which then go on with what was
/// not computed.
template<class... Functions>
void callAll(const Functions&... functions)
{
    std::array<std::exception_ptr, sizeof...(functions)> thrown;
    size_t next = 0;
    const auto caught = [&](const auto& function) {
        return [&function, &error = thrown[next++]] {
            try {
                function();
            } catch (...) {
                error = std::current_exception();
            }
        };
    };
    tbb::parallel_invoke(caught(functions)...);
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

} // namespace relamp
