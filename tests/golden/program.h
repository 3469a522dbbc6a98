#pragma once

#include <filesystem>
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

/// The same by a shell, which knows `>&-`; relamp is $RELAMP there.
Outcome runInShell(const std::string& command);

/// A file's bytes; none where it cannot be read.
std::string contentOf(const std::filesystem::path& file);

} // namespace relamp::golden
