#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace relamp
{

/// Calls `work(begin, end)` for consecutive chunks of [0, count), on all threads.
///
/// The chunks depend on `count` and `chunk` alone, never on the number of threads: work that keeps
/// one result a chunk and combines them in order gives the same answer on any machine.
template<class Work>
void forEachChunk(size_t count, size_t chunk, const Work& work)
{
    const size_t chunks = (count + chunk - 1) / chunk;
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<size_t>& range) {
            for (size_t i = range.begin(); i != range.end(); ++i)
                work(i * chunk, std::min(count, (i + 1) * chunk));
        },
        tbb::simple_partitioner());
}

/// Calls `work(i)` for every i in [0, count), on all threads.
template<class Work>
void forEach(size_t count, const Work& work)
{
    tbb::parallel_for(size_t{0}, count, work);
}

} // namespace relamp
