#include "base/child_process.h"

#include "scenes/refusal.h"

#include "relamp/error.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace relamp
{
namespace
{

using Bytes = std::vector<std::byte>;
using Work = std::function<void(const ByteSink&)>;
using testing::AnyOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const ChildSubject kSubject{"room.obj", "Export it again"};

Bytes sentBy(const Work& work, const ChildLimits& limits = {})
{
    const Progress progress;
    Bytes bytes;
    const auto take = [&](std::span<const std::byte> piece) {
        bytes.insert(bytes.end(), piece.begin(), piece.end());
    };
    runInChild(work, take, limits, kSubject, progress);
    return bytes;
}

std::string refusalOf(const Work& work, const ChildLimits& limits = {})
{
    return scenes::refusalOf([&] { sentBy(work, limits); });
}

void sleepLong(const ByteSink& /*send*/)
{
    std::this_thread::sleep_for(std::chrono::hours(1));
}

} // namespace

TEST(ChildProcess, WhatIsSentComesBackInOrder)
{
    for (const size_t count : {size_t{0}, size_t{1}, size_t{5'000'000}}) {
        Bytes all(count, std::byte{7});
        all.resize(2 * count, std::byte{8});
        const std::span<const std::byte> halves(all);
        const auto work = [&](const ByteSink& send) {
            send(halves.first(count));
            send(halves.subspan(count));
        };
        EXPECT_EQ(sentBy(work), all);
    }
}

TEST(ChildProcess, WhatTheWorkChangesIsLost)
{
    int touched = 0;
    sentBy([&](const ByteSink&) { ++touched; });
    EXPECT_EQ(touched, 0);
}

TEST(ChildProcess, AnErrorIsThrownHere)
{
    EXPECT_EQ(
        refusalOf([](const ByteSink&) { throw Error(ErrorCode::unsupported, "no such thing"); }),
        "no such thing");
    EXPECT_EQ(refusalOf([](const ByteSink& send) {
                  send(Bytes(5'000'000));
                  throw Error(ErrorCode::unsupported, "half of it is missing");
              }),
              "half of it is missing");
}

TEST(ChildProcess, WhatTakesItMayRefuseIt)
{
    const Progress progress;
    const auto work = [](const ByteSink& send) {
        for (;;) send(Bytes(1000));
    };
    const auto take = [](std::span<const std::byte>) {
        throw Error(ErrorCode::malformed, "too much of it");
    };
    EXPECT_EQ(scenes::refusalOf([&] { runInChild(work, take, {}, kSubject, progress); }),
              "too much of it");
}

TEST(ChildProcess, ACrashIsASentence)
{
    for (const Work& work : {Work([](const ByteSink&) { std::abort(); }),
                             Work([](const ByteSink&) { std::raise(SIGSEGV); }),
                             Work([](const ByteSink&) { throw 7; })}) {
        EXPECT_THAT(refusalOf(work), StartsWith("room.obj: cannot be read"));
        EXPECT_THAT(refusalOf(work), EndsWith("Export it again"));
    }
}

TEST(ChildProcess, AHangIsASentence)
{
    const auto hang = [](const ByteSink&) {
        for (std::atomic<int> i = 0;; ++i) {
        }
    };
    EXPECT_THAT(refusalOf(hang, {.seconds = 0.1}), HasSubstr("takes far longer to read"));
    EXPECT_THAT(refusalOf(sleepLong, {.seconds = 0.0}), HasSubstr("takes far longer to read"));
}

TEST(ChildProcess, GreedIsASentence)
{
    // Under a sanitizer the allocator itself gives up, which looks like any other crash.
    EXPECT_THAT(refusalOf([](const ByteSink& send) { send(Bytes(size_t{3} << 30)); }),
                AnyOf(HasSubstr("asks for far more memory"), HasSubstr("fails on it")));
}

TEST(ChildProcess, CancelledItDoesNotWait)
{
    Progress progress;
    progress.cancel();
    EXPECT_THROW(runInChild(
                     sleepLong, [](std::span<const std::byte>) {}, {}, kSubject, progress),
                 Error);
}

#ifndef RELAMP_SANITIZED // there one does
// Else the pipe of one would stay open as long as another that was made meanwhile.
TEST(ChildProcess, OneDoesNotWaitForAnother)
{
    int gate[2];
    ASSERT_EQ(pipe(gate), 0);
    const auto waitAtGate = [&](const ByteSink&) {
        std::byte pass{};
        if (read(gate[0], &pass, 1) != 1) throw Error(ErrorCode::cannotRead, "no gate");
    };
    constexpr size_t kWaiting = 8;
    std::vector<std::thread> waiting;
    for (size_t i = 0; i < kWaiting; ++i)
        waiting.emplace_back([&] { EXPECT_NO_THROW(sentBy(waitAtGate)); });
    const auto sendOne = [](const ByteSink& send) { send(Bytes(1)); };
    const auto askForOne = [&] { EXPECT_EQ(sentBy(sendOne, {.seconds = 1.0}), Bytes(1)); };
    for (int i = 0; i < 20; ++i) EXPECT_EQ(scenes::refusalOf(askForOne), "");
    const Bytes passes(kWaiting);
    EXPECT_EQ(write(gate[1], passes.data(), passes.size()), ssize_t{kWaiting});
    for (std::thread& one : waiting) one.join();
    close(gate[0]);
    close(gate[1]);
}

#endif

TEST(ChildProcess, NoneIsMadeWhileSomethingIsHalfway)
{
    std::atomic<bool> isHalfway = true;
    auto delay = delayCopies();
    bool sawHalfway = true;
    std::thread other([&] {
        sawHalfway =
            sentBy([&](const ByteSink& send) { send(Bytes(isHalfway ? 1 : 0)); }) == Bytes(1);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    isHalfway = false;
    delay.unlock();
    other.join();
    EXPECT_FALSE(sawHalfway);
}

} // namespace relamp
