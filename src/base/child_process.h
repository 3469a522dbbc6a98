#pragma once

#include "relamp/progress.h"

#include <cstddef>
#include <functional>
#include <shared_mutex>
#include <span>
#include <string>

namespace relamp
{

struct ChildLimits
{
    size_t memory = size_t{256} << 20; // bytes that it may take beyond what this process has
    double seconds = 10.0;             // of processors, all of its threads together
};

/// What the work is about, for a person.
struct ChildSubject
{
    std::string name;   // a sentence about it begins so
    std::string wayOut; // where the work fails on it
};

using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Runs `work` in a copy of this process. What it sends there comes to `take` here, in order, in
/// pieces of any length; nothing says that it is what an honest `work` would have sent.
///
/// For code of others that crashes, hangs or hoards memory when its input is broken: only the copy
/// suffers. Whatever else `work` changes is lost, and it must not wait for other threads: the copy
/// has only its own. An Error of `work` is thrown here, as is what `take` throws. Where the copy
/// does not come to its end, or goes beyond its limits, that is an Error(malformed) about
/// `subject`. Throws Error(cancelled) as Progress::check does.
void runInChild(const std::function<void(const ByteSink& send)>& work, const ByteSink& take,
                const ChildLimits& limits, const ChildSubject& subject, const Progress& progress);

/// No copy is made while this is held: for work whose threads or locks a copy would find halfway.
std::shared_lock<std::shared_mutex> delayCopies();

} // namespace relamp
