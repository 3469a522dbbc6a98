#pragma once

#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace relamp::fuzz
{

using Input = std::span<const uint8_t>;

inline std::span<const std::byte> bytesOf(Input input)
{
    return std::as_bytes(input);
}

inline std::string_view textOf(Input input)
{
    return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// A folder of this process, in memory, which goes when it ends as it should.
const std::filesystem::path& folder();

/// A file in there, for what wants one.
inline std::filesystem::path fileWith(std::string_view content, const std::string& name)
{
    std::ofstream(folder() / name, std::ios::binary) << content;
    return folder() / name;
}

/// Words of C++ and of libraries, which tell a person nothing.
constexpr std::array<std::string_view, 6> kLibraryWords{"[json",     "std::",    "basic_string",
                                                        "bad_alloc", "vector::", "max_size()"};

/// Calls `work`, which may refuse its input with a sentence that begins with a file, and in no
/// other way: with one of folder(), or of those named fuzz that are in memory alone.
template<class Work>
void expectResultOrSentence(Input input, const Work& work)
{
    try {
        work();
    } catch (const Error& error) {
        const std::string_view sentence = error.what();
        const auto quotes = [&](std::string_view word) {
            return textOf(input).find(word) != std::string_view::npos;
        };
        const auto speaks = [&](std::string_view word) {
            return sentence.find(word) != std::string_view::npos && !quotes(word);
        };
        if (!sentence.starts_with("fuzz") && !sentence.starts_with(folder().native())) std::abort();
        if (std::ranges::any_of(kLibraryWords, speaks)) std::abort();
    }
}

} // namespace relamp::fuzz
