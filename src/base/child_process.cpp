#include "base/child_process.h"

#include "base/fail.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relamp
{
namespace
{

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::byte>;

constexpr int kOutOfMemory = 3; // exit codes of the copy
constexpr int kFailed = 4;
constexpr int kPollMilliseconds = 50;
constexpr size_t kPipeSize = size_t{1} << 20;
constexpr auto kResult = std::byte{0xff}; // first byte of the answer; else the code of an Error

/// Address space that this process takes up, in bytes.
size_t addressSpace()
{
    unsigned long pages = 0;
    if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(statm, "%lu", &pages) != 1) pages = 0;
        std::fclose(statm);
    }
    return pages * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

void setLimit(int resource, rlim_t most)
{
    const rlimit limit{
        most, most + 1}; // at the upper one of RLIMIT_CPU there is no signal that tells why
    setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// Ends with its parent, dies without a word or a core file, and does not grow beyond `limits`.
void restrain(const ChildLimits& limits)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
        std::signal(fatal, SIG_DFL);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    setLimit(RLIMIT_CORE, 0);
    setLimit(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds) + 1);
    if (const size_t now = addressSpace(); now > 0) setLimit(RLIMIT_AS, now + limits.memory);
}

void send(int pipe, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = write(pipe, bytes.data(), bytes.size());
        if (sent < 0 && errno != EINTR) _exit(kFailed);
        if (sent > 0) bytes = bytes.subspan(static_cast<size_t>(sent));
    }
}

void answer(int pipe, std::byte kind, std::span<const std::byte> content)
{
    send(pipe, {&kind, 1});
    send(pipe, content);
}

[[noreturn]] void live(const std::function<Bytes()>& work, const ChildLimits& limits, int pipe)
{
    restrain(limits);
    try {
        answer(pipe, kResult, work());
    } catch (const Error& error) {
        const std::string sentence = error.what();
        answer(pipe, static_cast<std::byte>(error.code()), std::as_bytes(std::span(sentence)));
    } catch (const std::bad_alloc&) {
        _exit(kOutOfMemory);
    } catch (...) {
        _exit(kFailed);
    }
    _exit(0); // not exit(): what is to be done at the end is the parent's
}

/// The copy, and what it says. Ends it when nobody waits for it any more.
class Child
{
public:
    Child(const std::function<Bytes()>& work, const ChildLimits& limits, const std::string& what)
    {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) fail(ErrorCode::cannotRead, what, std::strerror(errno));
        pid_ = fork();
        if (pid_ == 0) {
            close(ends[0]);
            live(work, limits, ends[1]);
        }
        close(ends[1]);
        pipe_ = ends[0];
        if (pid_ < 0) {
            close(pipe_);
            fail(ErrorCode::cannotRead, what, std::strerror(errno));
        }
        fcntl(pipe_, F_SETPIPE_SZ,
              static_cast<int>(kPipeSize)); // fewer turns; refused, it still works
    }
    ~Child()
    {
        close(pipe_);
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Takes in what has come within a moment; false once all is there.
    bool listen(Bytes& bytes)
    {
        pollfd ready{pipe_, POLLIN, 0};
        if (poll(&ready, 1, kPollMilliseconds) <= 0) return true;
        const size_t before = bytes.size();
        bytes.resize(before + kPipeSize);
        const ssize_t count = read(pipe_, bytes.data() + before, kPipeSize);
        bytes.resize(before + static_cast<size_t>(std::max<ssize_t>(count, 0)));
        return count != 0;
    }

    /// Waits for its end; returns the status of waitpid.
    int wait()
    {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        return status;
    }

private:
    pid_t pid_ = -1;
    int pipe_ = -1;
};

constexpr const char* kWayOut = "The file is damaged; export it again, best as GLB";

[[noreturn]] void failOnStatus(int status, const std::string& what)
{
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory)
        malformed(
            what,
            fmt::format("asks for far more memory than a file of its size can need.\n{}", kWayOut));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        malformed(
            what,
            fmt::format("takes far longer to read than a file of its size can need.\n{}", kWayOut));
    malformed(what,
              fmt::format("cannot be read: the library that knows this format fails on it.\n{}",
                          kWayOut));
}

} // namespace

Bytes runInChild(const std::function<Bytes()>& work, const ChildLimits& limits,
                 const std::string& what, const Progress& progress)
{
    const auto deadline = Clock::now() + std::chrono::duration<double>(2.0 * limits.seconds + 1.0);
    Child child(work, limits, what);
    Bytes bytes;
    while (child.listen(bytes)) {
        progress.check();
        if (Clock::now() > deadline)
            malformed(what,
                      fmt::format("takes far longer to read than a file of its size can need.\n{}",
                                  kWayOut));
    }
    if (const int status = child.wait(); status != 0 || bytes.empty()) failOnStatus(status, what);
    const std::byte kind = bytes.front();
    bytes.erase(bytes.begin());
    if (kind == kResult) return bytes;
    throw Error(static_cast<ErrorCode>(kind),
                {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

} // namespace relamp
