#include "command.h"
#include "command_words.h"
#include "completions.h"
#include "interrupt.h"
#include "manual.h"
#include "scan_arguments.h"
#include "terminal.h"
#include "unexpected.h"

#include "relamp/error.h"
#include "relamp/version.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

namespace
{

constexpr int kWorldIsWrong = 1;
constexpr int kUsage = 2;

/// What was asked for may still lie in a buffer, and not fit where it has to go.
int endOutput(int exitCode)
{
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    printProblem(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
    return kWorldIsWrong;
}

/// A stream that is closed would be the first file that is opened, and what is printed would go
/// there. It becomes one that nobody can use.
void keepStandardStreams()
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// What is freed stays for what comes next, up to the end, which is near. Large arrays would else
/// go back to the system, which clears every page that it gives. Those of pages of 8192 x 8192 do:
/// there, room counts for more.
void keepMemory()
{
    mallopt(M_MMAP_THRESHOLD, 192 << 20);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

/// Help, or what is wrong with the command line, which names what somebody's files are called.
int answer(const CLI::ParseError& error, const CLI::App& app)
{
    std::ostringstream help;
    std::ostringstream complaint;
    const bool isHelp = app.exit(error, help, complaint) == 0;
    printExactly(help.str());
    if (isHelp) return endOutput(0);
    std::string sentences = complaint.str();
    if (sentences.ends_with('\n')) sentences.pop_back();
    printProblem(sentences);
    return kUsage;
}

/// For the build, which installs what is written; no command of a person's.
int writeReference(const CLI::App& app, const std::vector<std::string>& words)
{
    const CommandTable table = commandTable(app);
    if (writeManual(table, words[1] + "/man", words[2]) && writeCompletions(table, words[1]))
        return 0;
    printProblem(
        fmt::format("{}: the reference cannot be written, or {} not read", words[1], words[2]));
    return kWorldIsWrong;
}

int report(const relamp::Error& error)
{
    endProgressDisplay(Talk::normal);
    printProblem(error.what());
    return error.code() == relamp::ErrorCode::cancelled ? Interrupt::kExitCode : kWorldIsWrong;
}

} // namespace

int main(int argc, char** argv)
{
    std::signal(SIGPIPE, SIG_IGN); // a reader that went away, or a file size limit, is an error
    std::signal(SIGXFSZ, SIG_IGN); // to report, not a reason to vanish
    keepStandardStreams();
    keepMemory();

    CLI::App app("Takes the light out of a scanned room. What is left is the colour of its "
                 "surfaces (albedo), "
                 "the lights, and a room that can be lit anew.",
                 "relamp");
    app.set_version_flag("--version", std::string("relamp ") + relamp::version());
    app.require_subcommand(0, 1); // none is told of last, behind what was mistyped
    app.get_formatter()->column_width(34);
    app.footer("Examples:\n"
               "  relamp info kitchen.glb\n"
               "  relamp delight kitchen.glb -o kitchen\n"
               "  relamp relight kitchen --fixture all=on --bake -o baked.glb\n"
               "  relamp relight kitchen --lights lamp.json -o lamp.png\n"
               "  relamp verify kitchen\n"
               "  relamp view kitchen.glb\n"
               "relamp help COMMAND tells more.");
    Run run;
    addBenchCommand(app, run);
    addDelightCommand(app, run);
    addDevicesCommand(app, run);
    addInfoCommand(app, run);
    addPageCommand(app, run);
    addRelightCommand(app, run);
    addVerifyCommand(app, run);
    addViewCommand(app, run);
    refuseEmptyValues(app);
    std::vector<std::string> words = commandWords(argc, argv);
    if (words.size() == 3 && words[0] == "--write-reference") return writeReference(app, words);
    if (const std::string advice = adviceOnCommand(words, app); !advice.empty()) {
        printProblem(advice);
        return kUsage;
    }
    try {
        std::reverse(words.begin(), words.end()); // as CLI11 takes them
        app.parse(std::move(words));
        if (!run) throw CLI::RequiredError("A subcommand");
    } catch (const CLI::ParseError& error) {
        return answer(error, app);
    }
    try {
        return endOutput(run());
    } catch (const relamp::Error& error) {
        return report(error);
    } catch (const std::exception& error) {
        // Nobody expected it; still, what was half-written went as the stack was unwound.
        endProgressDisplay(Talk::normal);
        printProblem(sentenceOf(error));
        return kWorldIsWrong;
    }
}
