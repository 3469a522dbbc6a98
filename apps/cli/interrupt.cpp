#include "interrupt.h"

#include "terminal.h"

#include <chrono>
#include <csignal>

#include <unistd.h>

namespace
{

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::milliseconds(700);
constexpr timespec kPoll{0, 20'000'000};

sigset_t politeSignals()
{
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
}

} // namespace

Interrupt::Interrupt(relamp::Progress& progress) : progress_(progress)
{
    const sigset_t signals = politeSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr); // threads made from now on inherit it
    watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt()
{
    done_ = true;
    watcher_.join();
    if (isAsked_) kill(getpid(), SIGINT); // it stays blocked, and waits for who asks next
}

void Interrupt::watch()
{
    const sigset_t signals = politeSignals();
    while (!isAsked_ && !done_) isAsked_ = sigtimedwait(&signals, nullptr, &kPoll) >= 0;
    if (!isAsked_) return;
    progress_.cancel();
    const auto deadline = Clock::now() + kPatience;
    while (!done_ && Clock::now() < deadline && sigtimedwait(&signals, nullptr, &kPoll) < 0) {
    }
    if (done_) return;
    progress_.abandon();
    printProblem("interrupted");
    _exit(kExitCode);
}
