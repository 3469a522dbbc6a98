#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace relamp::fuzz
{

/// What stands in a room's folder and is read again, the scan included. The first ones are what a
/// person edits or a copy cuts off, and the fuzzer's first choice.
constexpr std::array<const char*, 9> kFilesOfResult{
    "out/report.json",    "out/lights.json",    "out/transport.bin",
    "out/albedo.exr",     "out/confidence.png", "out/fixtures.png",
    "out/correction.png", "out/fuzz.glb",       "fuzz.glb"};

/// Some of kFilesOfResult, by index.
using ResultFiles = std::map<uint8_t, std::string>;

/// All in one: the index as a byte, the length in four, the bytes of the file; the next.
inline std::string joined(const ResultFiles& files)
{
    std::string bytes;
    for (const auto& [index, content] : files) {
        bytes += static_cast<char>(index);
        const auto length = static_cast<uint32_t>(content.size());
        bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
        bytes += content;
    }
    return bytes;
}

/// What `joined` joined; of other bytes, as much as can be told apart.
inline ResultFiles split(std::string_view bytes)
{
    ResultFiles files;
    while (bytes.size() > sizeof(uint32_t)) {
        uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 1, sizeof length);
        const auto index =
            static_cast<uint8_t>(static_cast<uint8_t>(bytes[0]) % kFilesOfResult.size());
        bytes.remove_prefix(1 + sizeof length);
        files[index] = bytes.substr(0, length);
        bytes.remove_prefix(files[index].size());
    }
    return files;
}

} // namespace relamp::fuzz
