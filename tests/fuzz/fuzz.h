#pragma once

#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
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

/// Tells what it was that a run must not do, and ends it.
[[noreturn]] inline void fail(std::string_view sentence)
{
    std::fprintf(stderr, "no sentence for a person: %.*s\n", static_cast<int>(sentence.size()),
                 sentence.data());
    std::abort();
}

/// Calls `work`, which may refuse its input with a sentence that names a file, and in no other
/// way: one of folder(), by whatever way from here, or one named fuzz that is in memory alone.
template<class Work>
void expectResultOrSentence(Input input, const Work& work)
{
    try {
        work();
    } catch (const Error& error) {
        const std::string_view sentence = error.what();
        const auto quotes = [&](std::string_view word) { // an escape, as \x0b, may end as it begins
            word.remove_prefix(std::isxdigit(static_cast<unsigned char>(word.front())) ? 1 : 0);
            return textOf(input).find(word) != std::string_view::npos;
        };
        const auto speaks = [&](std::string_view word) {
            return sentence.find(word) != std::string_view::npos && !quotes(word);
        };
        const bool isOfFolder =
            sentence.find(folder().filename().native()) != std::string_view::npos;
        if (!isOfFolder && !sentence.starts_with("fuzz")) fail(sentence);
        if (std::ranges::any_of(kLibraryWords, speaks)) fail(sentence);
    }
}

} // namespace relamp::fuzz
