#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

/// Brings what other threads have found to the thread that shows it.
class Mailbox
{
public:
    using Letter = std::function<void()>;

    /// `wake` is called from any thread when a letter lies there.
    explicit Mailbox(std::function<void()> wake) : wake_(std::move(wake)) {}

    void post(Letter letter)
    {
        {
            const std::lock_guard lock(mutex_);
            letters_.push_back(std::move(letter));
        }
        wake_();
    }

    /// Runs all letters, in their order, on the calling thread. False where there was none.
    bool deliver()
    {
        std::vector<Letter> letters;
        {
            const std::lock_guard lock(mutex_);
            letters.swap(letters_);
        }
        for (const Letter& letter : letters) letter();
        return !letters.empty();
    }

private:
    std::function<void()> wake_;
    std::mutex mutex_;
    std::vector<Letter> letters_;
};
