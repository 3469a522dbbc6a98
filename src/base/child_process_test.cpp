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

namespace relamp
{
namespace
{

using Bytes = std::vector<std::byte>;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusalOf(const std::function<Bytes()>& work, const ChildLimits& limits = {})
{
    Progress progress;
    return scenes::refusalOf([&] { runInChild(work, limits, "room.obj", progress); });
}

} // namespace

TEST(ChildProcess, BytesComeBackWhateverTheirNumber)
{
    Progress progress;
    for (const size_t count : {size_t{0}, size_t{1}, size_t{5'000'000}}) {
        const Bytes bytes =
            runInChild([&] { return Bytes(count, std::byte{7}); }, {}, "", progress);
        EXPECT_EQ(bytes, Bytes(count, std::byte{7}));
    }
}

TEST(ChildProcess, WhatTheWorkChangesIsLost)
{
    Progress progress;
    int touched = 0;
    runInChild([&] { return ++touched, Bytes(); }, {}, "", progress);
    EXPECT_EQ(touched, 0);
}

TEST(ChildProcess, AnErrorIsThrownHere)
{
    EXPECT_EQ(refusalOf([]() -> Bytes { throw Error(ErrorCode::unsupported, "no such thing"); }),
              "no such thing");
}

TEST(ChildProcess, ACrashIsASentence)
{
    EXPECT_THAT(refusalOf([]() -> Bytes { std::abort(); }), StartsWith("room.obj: cannot be read"));
    EXPECT_THAT(refusalOf([]() -> Bytes { return std::raise(SIGSEGV), Bytes(); }),
                StartsWith("room.obj: cannot be read"));
    EXPECT_THAT(refusalOf([]() -> Bytes { throw 7; }), StartsWith("room.obj: cannot be read"));
}

TEST(ChildProcess, AHangIsASentence)
{
    const auto hang = []() -> Bytes {
        for (std::atomic<int> i = 0;; ++i) {
        }
    };
    EXPECT_THAT(refusalOf(hang, {.seconds = 0.1}), HasSubstr("takes far longer to read"));
    const auto sleep = []() -> Bytes {
        std::this_thread::sleep_for(std::chrono::hours(1));
        return {};
    };
    EXPECT_THAT(refusalOf(sleep, {.seconds = 0.0}), HasSubstr("takes far longer to read"));
}

TEST(ChildProcess, GreedIsASentence)
{
    // Under a sanitizer the allocator itself gives up, which looks like any other crash.
    EXPECT_THAT(refusalOf([] { return Bytes(size_t{3} << 30); }),
                AnyOf(HasSubstr("asks for far more memory"), HasSubstr("fails on it")));
}

TEST(ChildProcess, CancelledItDoesNotWait)
{
    Progress progress;
    progress.cancel();
    const auto sleep = []() -> Bytes {
        std::this_thread::sleep_for(std::chrono::hours(1));
        return {};
    };
    EXPECT_THROW(runInChild(sleep, {}, "", progress), Error);
}

} // namespace relamp
