#pragma once

#include "relamp/api.h"

#include <memory>

namespace relamp
{

/// Limits how many threads relamp works with, for as long as it lives. The results do not depend on
/// it.
class RELAMP_API ThreadLimit
{
public:
    /// `count` >= 1; 0 means one a core.
    explicit ThreadLimit(int count);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Control;
    std::unique_ptr<Control> control_;
};

} // namespace relamp
