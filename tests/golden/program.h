#pragma once

#include <string>
#include <vector>

namespace relamp::golden
{

/// How a run of the real program ended.
struct Outcome
{
    int exitCode = -1; // 128 + signal where one ended it
    std::string out;
    std::string err;
};

/// Runs relamp with `arguments`. With `interruptAfter` > 0 seconds it gets a Ctrl-C then.
Outcome runRelamp(const std::vector<std::string>& arguments, double interruptAfter = 0.0);

} // namespace relamp::golden
