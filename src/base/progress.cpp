#include "relamp/progress.h"

#include "relamp/error.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

double Progress::elapsed() const
{
    return secondsSince(start_);
}

void Progress::check() const
{
    if (cancelled_.load(std::memory_order_relaxed))
        throw Error(ErrorCode::cancelled, "interrupted; nothing was written");
}

void Progress::removeIfAbandoned(const std::filesystem::path& path)
{
    const std::lock_guard lock(mutex_);
    unfinished_.push_back(path);
}

void Progress::abandon()
{
    const std::lock_guard lock(mutex_);
    std::error_code ignored;
    for (const auto& path : unfinished_)
        for (int attempt = 0; attempt < 3 && std::filesystem::exists(path, ignored); ++attempt)
            std::filesystem::remove_all(path,
                                        ignored); // again: someone may still be writing into it
}

void Progress::setPart(std::string part)
{
    const std::lock_guard lock(mutex_);
    part_ = std::move(part);
}

std::vector<Progress::StageTime> Progress::times() const
{
    const std::lock_guard lock(mutex_);
    return times_;
}

void Progress::report(std::string_view stage, double fraction)
{
    if (!sink_) return;
    const std::lock_guard lock(mutex_);
    sink_({stage, fraction, part_});
}

void Progress::ended(const std::string& stage, double seconds)
{
    const std::lock_guard lock(mutex_);
    const auto sameStage = [&](const StageTime& time) { return time.stage == stage; };
    const auto found = std::find_if(times_.begin(), times_.end(), sameStage);
    if (found == times_.end())
        times_.push_back({stage, seconds});
    else
        found->seconds += seconds;
}

Progress::Stage::Stage(Progress& progress, std::string_view name, size_t steps)
    : progress_(progress), name_(name), steps_(std::max<size_t>(steps, 1)),
      start_(std::chrono::steady_clock::now()), outer_(progress.innermost_)
{
    progress_.check();
    progress_.report(name_, 0.0);
    progress_.innermost_ = this;
}

Progress::Stage::~Stage()
{
    const double seconds = secondsSince(start_);
    progress_.ended(name_, seconds - secondsOfInner_);
    if (outer_ != nullptr) outer_->secondsOfInner_ += seconds;
    progress_.innermost_ = outer_;
}

void Progress::Stage::advance(size_t steps)
{
    progress_.check();
    const size_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
    progress_.report(name_, std::min(1.0, static_cast<double>(done) / static_cast<double>(steps_)));
}

} // namespace relamp
