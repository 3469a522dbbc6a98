#pragma once

#include <optional>
#include <utility>

namespace relamp
{

/// What a stage made, and what from: it need not be made again while that is the same.
template<class Inputs, class Value>
class Kept
{
public:
    /// The value for `inputs`, made by `make()` where they are not those of the last time. Where
    /// that throws, what was kept is gone.
    template<class Make>
    const Value& of(const Inputs& inputs, const Make& make)
    {
        if (kept_ && kept_->first == inputs) return kept_->second;
        kept_.reset();
        kept_.emplace(inputs, make());
        return kept_->second;
    }

private:
    std::optional<std::pair<Inputs, Value>> kept_;
};

} // namespace relamp
