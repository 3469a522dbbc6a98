#pragma once

#include "relamp/progress.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace relamp
{

struct ChildLimits
{
    size_t memory = size_t{256} << 20; // bytes that it may take beyond what this process has
    double seconds = 10.0;
};

/// Runs `work` in a copy of this process and returns the bytes that it returned there.
///
/// For code of others that crashes, hangs or hoards memory when its input is broken: only the copy
/// suffers. Whatever else `work` changes is lost, and it must not wait for other threads: the copy
/// has only its own. An Error of `work` is thrown here. Where the copy does not come back, or goes
/// beyond its limits, that is an Error(malformed) that begins with `what`. Throws Error(cancelled)
/// as Progress::check does.
std::vector<std::byte> runInChild(const std::function<std::vector<std::byte>()>& work,
                                  const ChildLimits& limits, const std::string& what,
                                  const Progress& progress);

} // namespace relamp
