#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// What a person did, to be undone and done again: values of the whole state, which is small.
///
/// Changes under one name that follow each other without `settle` between them are one: a drag is
/// undone as a whole.
template<class State>
class History
{
public:
    explicit History(State first) : steps_{{std::move(first), ""}} {}

    /// Takes over the state as it is now. Nothing where it is as it was.
    void record(const State& state, const std::string& name)
    {
        if (state == steps_[at_].state) return;
        const bool continues = !isSettled_ && at_ > 0 && steps_[at_].name == name;
        steps_.resize(at_ + 1);
        if (continues) {
            steps_[at_].state = state;
            return;
        }
        steps_.push_back({state, name});
        if (steps_.size() > kMost) steps_.erase(steps_.begin());
        at_ = steps_.size() - 1;
        isSettled_ = false;
    }

    /// What comes next is a step of its own.
    void settle() { isSettled_ = true; }

    [[nodiscard]] bool canUndo() const { return at_ > 0; }
    [[nodiscard]] bool canRedo() const { return at_ + 1 < steps_.size(); }
    [[nodiscard]] const std::string& undoName() const { return steps_[at_].name; }
    const State& undo() { return go(canUndo() ? at_ - 1 : at_); }
    const State& redo() { return go(canRedo() ? at_ + 1 : at_); }

private:
    static constexpr size_t kMost = 500;

    struct Step
    {
        State state;
        std::string name; // of the change that led to it
    };

    const State& go(size_t to)
    {
        at_ = to;
        isSettled_ = true;
        return steps_[at_].state;
    }

    std::vector<Step> steps_;
    size_t at_ = 0;
    bool isSettled_ = true;
};
