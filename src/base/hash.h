#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace relamp
{

/// A fingerprint of numbers: tells whether they are still the same, not whether somebody forged
/// them. Words are mixed as SplitMix64 does.
class Hash
{
public:
    void add(uint64_t word)
    {
        state_ = (state_ ^ word) * 0xbf58476d1ce4e5b9u;
        state_ ^= state_ >> 29;
    }
    void addBytes(std::span<const std::byte> bytes)
    {
        add(bytes.size());
        for (size_t at = 0; at < bytes.size(); at += sizeof(uint64_t)) {
            uint64_t word = 0;
            std::memcpy(&word, &bytes[at], std::min(sizeof word, bytes.size() - at));
            add(word);
        }
    }
    template<class T>
    void add(const std::vector<T>& values)
    {
        addBytes(std::as_bytes(std::span(values)));
    }

    [[nodiscard]] uint64_t value() const { return state_; }

private:
    uint64_t state_ = 0x9e3779b97f4a7c15u;
};

} // namespace relamp
