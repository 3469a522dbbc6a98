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

/// A folder of its own that goes with the object.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
    {
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace relamp::golden
