#include "malformed/run_in_folder.h"

#include <algorithm>

#include <sys/resource.h>

#include <gmock/gmock.h>

namespace relamp::malformed
{

using golden::Outcome;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace
{

/// A sentence that begins with the file, or with one beside it.
auto namesFile(const std::filesystem::path& file)
{
    return StartsWith("relamp: " + file.parent_path().string() + "/");
}

/// Of all runs that have ended. On a busy machine a clock tells of others' work.
double processorSeconds()
{
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

} // namespace

void RunInFolder::write(const SmallScan& scan) const
{
    write(scan.name, scan.bytes);
    for (const auto& [name, bytes] : scan.beside) write(name, bytes);
}

std::vector<std::string> RunInFolder::names() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

Outcome RunInFolder::delight(const std::string& file, const std::vector<std::string>& more) const
{
    std::vector<std::string> arguments{"delight", folder / file, "-o", folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const double before = processorSeconds();
    Outcome run = golden::runRelamp(arguments);
    EXPECT_LT(processorSeconds() - before, 10.0) << file;
    EXPECT_THAT(run.exitCode, AnyOf(0, 1)) << file << '\n' << run.err;
    return run;
}

void RunInFolder::expectRefused(const std::string& file, const std::string& words,
                                const std::vector<std::string>& more) const
{
    const std::vector<std::string> before = names();
    std::vector<std::string> arguments{"-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = delight(file, arguments);
    EXPECT_EQ(run.exitCode, 1) << file;
    EXPECT_EQ(run.out, "") << file;
    EXPECT_THAT(run.err, namesFile(folder / file));
    EXPECT_THAT(run.err, HasSubstr(words)) << file;
    EXPECT_THAT(names(), testing::ElementsAreArray(before)) << file;
}

void RunInFolder::expectTaken(const std::string& file, const std::string& words) const
{
    const Outcome run = delight(file);
    EXPECT_EQ(run.exitCode, 0) << file << '\n' << run.err;
    EXPECT_THAT(run.err, HasSubstr(words)) << file;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/report.json")) << file;
    std::filesystem::remove_all(folder / "out");
}

void RunInFolder::expectResultOrSentence(const std::string& file) const
{
    const std::vector<std::string> before = names();
    const Outcome run = delight(file, {"-q"});
    if (run.exitCode == 0)
        EXPECT_TRUE(std::filesystem::exists(folder / "out/report.json")) << file;
    else
        EXPECT_THAT(run.err, namesFile(folder / file));
    std::filesystem::remove_all(folder / "out");
    EXPECT_THAT(names(), testing::ElementsAreArray(before)) << file; // and no staging
}

} // namespace relamp::malformed
