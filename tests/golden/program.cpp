#include "golden/program.h"

#include "scenes/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relamp::golden
{
namespace
{

[[noreturn]] void become(const char* program, const std::vector<std::string>& arguments,
                         const std::string& out, const std::string& err)
{
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
    setenv("RELAMP", RELAMP_PROGRAM, 1);
    std::vector<char*> argv{const_cast<char*>(program)};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(program, argv.data());
    _exit(127);
}

Outcome run(const char* program, const std::vector<std::string>& arguments, double interruptAfter)
{
    const scenes::TemporaryFolder folder;
    const std::string out = folder / "out";
    const std::string err = folder / "err";
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) become(program, arguments, out, err);
    if (interruptAfter > 0.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(interruptAfter));
        kill(child, SIGINT);
    }
    int status = 0;
    waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, contentOf(out), contentOf(err)};
}

} // namespace

Outcome runRelamp(const std::vector<std::string>& arguments, double interruptAfter)
{
    return run(RELAMP_PROGRAM, arguments, interruptAfter);
}

Outcome runInShell(const std::string& command)
{
    return run("/bin/sh", {"-c", command}, 0.0);
}

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace relamp::golden
