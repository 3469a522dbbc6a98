#pragma once

#include "relamp/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace relamp::fuzz
{

inline std::span<const std::byte> bytesOf(const uint8_t* data, size_t size)
{
    return {reinterpret_cast<const std::byte*>(data), size};
}

inline std::string_view textOf(const uint8_t* data, size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// Calls `read`, which may refuse its input with a sentence that names `name`, and in no other way.
template<class Read>
void expectResultOrSentence(const std::string& name, const Read& read)
{
    try {
        read();
    } catch (const Error& error) {
        if (!std::string_view(error.what()).starts_with(name)) std::abort();
    }
}

/// A file of this process, in memory, for readers that want one. `name` is its ending.
inline std::filesystem::path fileWith(std::string_view content, const std::string& name)
{
    static const std::string folder = [] {
        std::string pattern = "/dev/shm/relamp-fuzz-XXXXXX";
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        return pattern;
    }();
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
}

} // namespace relamp::fuzz
