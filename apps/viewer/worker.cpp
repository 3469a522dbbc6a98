#include "worker.h"

#include "relamp/error.h"

#include <new>
#include <utility>

Worker::Worker(std::function<void()> changed, std::function<void(const std::string&)> failed)
    : changed_(std::move(changed)), failed_(std::move(failed)),
      thread_([this](const std::stop_token& stop) { work(stop); })
{}

Worker::~Worker()
{
    thread_.request_stop();
    cancel();
}

void Worker::start(Job job)
{
    {
        const std::lock_guard lock(mutex_);
        if (progress_) progress_->cancel();
        next_ = std::move(job);
        status_ = {true, "", 0.0};
    }
    asked_.notify_one();
}

void Worker::cancel()
{
    const std::lock_guard lock(mutex_);
    if (progress_) progress_->cancel();
    next_ = nullptr;
    if (!progress_) status_ = {};
}

WorkStatus Worker::status() const
{
    const std::lock_guard lock(mutex_);
    return status_;
}

void Worker::report(const relamp::Progress::Event& event)
{
    {
        const std::lock_guard lock(mutex_);
        status_ = {true, std::string(event.stage), event.fraction};
    }
    changed_();
}

void Worker::work(const std::stop_token& stop)
{
    while (true) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            if (!asked_.wait(lock, stop, [this] { return next_ != nullptr; })) return;
            job = std::exchange(next_, nullptr);
            progress_ = std::make_shared<relamp::Progress>(
                [this](const relamp::Progress::Event& event) { report(event); });
        }
        run(job);
        {
            const std::lock_guard lock(mutex_);
            progress_ = nullptr;
            if (!next_) status_ = {};
        }
        changed_();
    }
}

void Worker::run(const Job& job)
{
    try {
        job(*progress_);
    } catch (const relamp::Error& error) {
        if (error.code() != relamp::ErrorCode::cancelled) failed_(error.what());
    } catch (const std::bad_alloc&) {
        failed_("this machine has not enough memory for the scan; scale its textures down");
    } catch (const std::exception& error) {
        failed_(error.what());
    }
}
