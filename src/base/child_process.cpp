#include "base/child_process.h"

#include "base/fail.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef RELAMP_SANITIZED
#include <sanitizer/common_interface_defs.h>

namespace __lsan // in the sanitizer's library, of a program that it is linked into
{
[[gnu::weak]] void LockThreadRegistry();
[[gnu::weak]] void LockAllocator();
[[gnu::weak]] void UnlockAllocator();
[[gnu::weak]] void UnlockThreadRegistry();
} // namespace __lsan
#endif

namespace relamp
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr int kOutOfMemory = 3; // exit codes of the copy
constexpr int kFailed = 4;
constexpr int kRefused = 5; // and said why
constexpr int kPollMilliseconds = 50;
constexpr double kMostWaits =
    10.0; // seconds of clock for one of processors, where others work, too
constexpr size_t kPipeSize = size_t{1} << 20;
constexpr const char* kTooLong = "takes far longer to read than a file of its size can need";
constexpr size_t kLongestRefusal = 4096; // the code of the Error and its sentence; a pipe holds it

/// Held alone while a copy is made. A second one made meanwhile would hold on to the pipes of the
/// first, which would not seem to end before it.
std::shared_mutex& copying()
{
    static std::shared_mutex mutex;
    return mutex;
}

/// As fork(), and memory can be had in the copy. The C library sees to that; the allocator of the
/// sanitizer knows nothing of copies, and in one that is made while another thread has it locked it
/// would be locked for ever.
pid_t copyThisProcess()
{
#ifdef RELAMP_SANITIZED
    if (__lsan::LockAllocator == nullptr) return fork();
    __lsan::LockThreadRegistry();
    __lsan::LockAllocator();
    const pid_t pid = fork();
    __lsan::UnlockAllocator();
    __lsan::UnlockThreadRegistry();
    return pid;
#else
    return fork();
#endif
}

/// Bytes of this process that are its own to write; not all of it has to be there.
size_t ownMemory()
{
    unsigned long pages = 0;
    if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(statm, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
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
#ifdef RELAMP_SANITIZED
    __sanitizer_set_death_callback(nullptr); // a fuzzer's, which keeps what it takes for a find
#endif
    for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
        std::signal(fatal, SIG_DFL);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    setLimit(RLIMIT_CORE, 0);
    setLimit(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds) + 1);
    if (const size_t now = ownMemory(); now > 0) setLimit(RLIMIT_DATA, now + limits.memory);
}

void send(int pipe, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = write(pipe, bytes.data(), bytes.size());
        if (sent < 0 && errno != EINTR) _exit(kFailed);
        if (sent > 0) bytes = bytes.subspan(static_cast<size_t>(sent));
    }
}

void refuse(int pipe, const Error& error)
{
    std::string words(1, static_cast<char>(error.code()));
    words += error.what();
    send(pipe, std::as_bytes(std::span(words)).first(std::min(words.size(), kLongestRefusal)));
    _exit(kRefused);
}

/// Both ends, closed with it.
struct Pipe
{
    explicit Pipe(const std::string& subject)
    {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) fail(ErrorCode::cannotRead, subject, std::strerror(errno));
        out = ends[0];
        in = ends[1];
    }
    ~Pipe()
    {
        close(out);
        closeIn();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    void closeIn()
    {
        if (in >= 0) close(in);
        in = -1;
    }

    int out = -1;
    int in = -1;
};

[[noreturn]] void live(const std::function<void(const ByteSink&)>& work, const ChildLimits& limits,
                       const Pipe& result, const Pipe& words)
{
    restrain(limits);
    try {
        work([&](std::span<const std::byte> bytes) { send(result.in, bytes); });
    } catch (const Error& error) {
        refuse(words.in, error);
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
    Child(const std::function<void(const ByteSink&)>& work, const ChildLimits& limits,
          const std::string& subject)
        : alone_(copying()), result_(subject), words_(subject), pid_(copyThisProcess())
    {
        if (pid_ == 0) live(work, limits, result_, words_);
        const int reason = errno;
        result_.closeIn();
        words_.closeIn();
        alone_.unlock();
        if (pid_ < 0) fail(ErrorCode::cannotRead, subject, std::strerror(reason));
        fcntl(result_.out, F_SETPIPE_SZ,
              static_cast<int>(kPipeSize)); // fewer turns; refused, it still works
    }
    ~Child()
    {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Passes on what has come within a moment; false once all has.
    bool listen(const ByteSink& take)
    {
        pollfd ready{result_.out, POLLIN, 0};
        if (poll(&ready, 1, kPollMilliseconds) <= 0) return true;
        const ssize_t count = read(result_.out, piece_.data(), piece_.size());
        if (count > 0) take(std::span(piece_).first(static_cast<size_t>(count)));
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

    /// Once it has ended, what it refused with.
    [[nodiscard]] Error refusal() const
    {
        std::string words(kLongestRefusal, '\0');
        const ssize_t count = read(words_.out, words.data(), words.size());
        words.resize(static_cast<size_t>(std::max<ssize_t>(count, 1)));
        return {static_cast<ErrorCode>(words.front()), words.substr(1)};
    }

private:
    std::unique_lock<std::shared_mutex> alone_;
    Pipe result_;
    Pipe words_;
    pid_t pid_;
    std::vector<std::byte> piece_{kPipeSize};
};

[[noreturn]] void failOnStatus(int status, const ChildSubject& subject)
{
    std::string reason = "cannot be read: the library that knows this format fails on it";
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory)
        reason = "asks for far more memory than a file of its size can need";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) reason = kTooLong;
    malformed(subject.name, fmt::format("{}.\n{}", reason, subject.wayOut));
}

} // namespace

void runInChild(const std::function<void(const ByteSink& send)>& work, const ByteSink& take,
                const ChildLimits& limits, const ChildSubject& subject, const Progress& progress)
{
#ifdef RELAMP_SANITIZED
    // Where copyThisProcess() cannot lock the allocator, at least those that wait here do not.
    static std::mutex oneAtATime;
    const std::lock_guard alone(oneAtATime);
#endif
    const auto deadline = Clock::now() + kMostWaits * std::chrono::duration<double>(limits.seconds);
    Child child(work, limits, subject.name);
    while (child.listen(take)) {
        progress.check();
        if (Clock::now() > deadline)
            malformed(subject.name, fmt::format("{}.\n{}", kTooLong, subject.wayOut));
    }
    const int status = child.wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused) throw child.refusal();
    if (status != 0) failOnStatus(status, subject);
}

std::shared_lock<std::shared_mutex> delayCopies()
{
    return std::shared_lock(copying());
}

} // namespace relamp
