#pragma once

#include "relamp/progress.h"

#include <functional>
#include <optional>

#include <pybind11/pybind11.h>

/// Runs what takes long on a thread of its own and waits for it without the GIL, so that other
/// threads of Python go on and this one hears Ctrl-C. `watcher` is None, or called with the name of
/// the stage and how much of it is done, 0..1, some twenty times a second at most. `threads`, as
/// relamp::ThreadLimit has it, are those that `work` may use.
///
/// Throws what `work` throws; what `watcher` or a signal's handler raises cancels `work` first.
void runWatched(const pybind11::object& watcher, int threads,
                const std::function<void(relamp::Progress&)>& work);

/// The same of work that has a result.
template<class Work>
auto watched(const pybind11::object& watcher, int threads, const Work& work)
{
    std::optional<std::invoke_result_t<Work, relamp::Progress&>> result;
    runWatched(watcher, threads,
               [&](relamp::Progress& progress) { result.emplace(work(progress)); });
    return std::move(*result);
}
