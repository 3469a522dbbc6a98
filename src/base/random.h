#pragma once

#include <cstdint>

namespace relamp
{

/// Random numbers that belong to a place: the same whoever draws them, on any thread, at any time.
///
/// SplitMix64 (Steele, Lea & Flood 2014), which passes BigCrush and starts well from any number.
class Random
{
public:
    /// Numbers of one `index` in one `sequence` have nothing to do with those of another.
    Random(uint64_t seed, uint64_t sequence, uint64_t index)
        : state_(mixed(mixed(mixed(seed) + sequence) + index))
    {}

    /// Evenly in [0, 1).
    float next()
    {
        state_ += 0x9e3779b97f4a7c15u;
        return static_cast<float>(mixed(state_) >> 40) * 0x1p-24f;
    }

private:
    static uint64_t mixed(uint64_t z)
    {
        z += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    uint64_t state_;
};

} // namespace relamp
