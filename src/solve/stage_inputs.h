#pragma once

#include <utility>
#include <vector>

namespace relamp
{

/// What a stage was last computed from, as numbers: its parameters, and the versions of the stages
/// before it.
class StageInputs
{
public:
    /// Whether they are not what they were; then they are now, and the version is another.
    bool change(std::vector<double> inputs)
    {
        if (known_ && inputs == inputs_) return false;
        inputs_ = std::move(inputs);
        known_ = true;
        ++version_;
        return true;
    }
    void forget() { known_ = false; }
    [[nodiscard]] double version() const { return version_; }

private:
    std::vector<double> inputs_;
    double version_ = 0.0;
    bool known_ = false;
};

} // namespace relamp
