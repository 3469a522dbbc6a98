#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace relamp::fuzz
{

/// How one element of a JSON text's lists is made many: a small input, a large file.
struct Growth
{
    static constexpr size_t kBytes = 4; // that say it
    static constexpr size_t kMost = 4;  // of one text

    uint16_t element = 0;  // in the order in which they end, of as many as there are
    uint8_t size = 0;      // 255: a million times; most are far below, for what is large takes long
    bool isNested = false; // within as many lists, instead of so often behind itself

    [[nodiscard]] size_t times() const;
};

/// Of kBytes bytes.
Growth growthFrom(std::span<const uint8_t> bytes);

/// `json` with one growth after the other, at most kMost and as long as it stays below 4 MiB.
/// Numbers count up from the one that is repeated, as indices do; all else is repeated as it is.
std::string grown(std::string_view json, std::span<const uint8_t> growths);

} // namespace relamp::fuzz
