#include "script.h"

#include "text_file.h"

#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace
{

constexpr size_t kAny = 64;

constexpr std::array<ScriptWord, 19> kWords{{
    {"open", 1, 1, "open FILE"},
    {"wait", 1, 1, "wait SECONDS, or wait scan, draft, solve, glance, relit or rest"},
    {"press", 1, 1, "press KEY, as in press ctrl+z"},
    {"hold", 2, 2, "hold KEY SECONDS"},
    {"click", 2, 3, "click X Y [left|right|middle]"},
    {"drag", 4, 5, "drag X Y X Y [left|right|middle]"},
    {"move", 2, 2, "move X Y"},
    {"scroll", 1, 1, "scroll STEPS"},
    {"type", 1, 1, "type TEXT"},
    {"drop", 1, 1, "drop FILE"},
    {"size", 2, 2, "size WIDTH HEIGHT"},
    {"set", 2, kAny, "set NAME VALUE ..."},
    {"do", 1, 2, "do ACTION [VALUE]"},
    {"save", 2, 2, "save lights|result|baked|page FILE"},
    {"screenshot", 1, 2, "screenshot FILE [view]"},
    {"measure", 1, 1, "measure SECONDS"},
    {"random", 2, 2, "random SECONDS SEED"},
    {"stay", 0, 0, "stay"},
    {"quit", 0, 0, "quit"},
}};

[[noreturn]] void fail(const std::string& name, size_t line, const std::string& what)
{
    throw relamp::Error(relamp::ErrorCode::malformed,
                        fmt::format("{} line {}: {}", name, line, what));
}

std::vector<std::string> wordsOf(std::string_view line, const std::string& name, size_t number)
{
    std::vector<std::string> words;
    for (size_t at = 0; at < line.size();) {
        const char c = line[at];
        if (c == '#') break;
        if (c == ' ' || c == '\t' || c == '\r') {
            ++at;
        } else if (c == '"') {
            const size_t end = line.find('"', at + 1);
            if (end == std::string_view::npos) fail(name, number, "a quotation mark is missing");
            words.emplace_back(line.substr(at + 1, end - at - 1));
            at = end + 1;
        } else {
            const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
            words.emplace_back(line.substr(at, end - at));
            at = end;
        }
    }
    return words;
}

void checkCommand(const ScriptCommand& command, const std::string& name)
{
    const auto* found = std::find_if(kWords.begin(), kWords.end(),
                                     [&](const ScriptWord& w) { return command.name == w.name; });
    if (found == kWords.end()) {
        std::string known;
        for (const ScriptWord& word : kWords)
            known += (known.empty() ? "" : ", ") + std::string(word.name);
        fail(name, command.line,
             fmt::format("\"{}\" is no command; there are {}", command.name, known));
    }
    if (command.words.size() < found->fewest || command.words.size() > found->most)
        fail(name, command.line, fmt::format("it must read: {}", found->usage));
}

/// The number that a word is, to its last letter.
template<class Number>
std::optional<Number> wholeWord(const std::string& word)
{
    Number value{};
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

} // namespace

std::vector<ScriptCommand> parseScript(std::string_view text, const std::string& name)
{
    std::vector<ScriptCommand> commands;
    size_t number = 0;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        std::vector<std::string> words = wordsOf(text.substr(begin, end - begin), name, ++number);
        begin = end + 1;
        if (words.empty()) continue;
        ScriptCommand command{number, words.front(), {words.begin() + 1, words.end()}};
        checkCommand(command, name);
        if (!commands.empty() && commands.back().name == "stay")
            fail(name, number, "nothing can follow stay: mouse and keys are a person's from there");
        commands.push_back(std::move(command));
    }
    return commands;
}

std::vector<ScriptCommand> readScript(const std::filesystem::path& file)
{
    return parseScript(textFrom(file), file.string());
}

float numberOf(const std::string& word)
{
    const std::optional<float> value = wholeWord<float>(word);
    if (!value || !std::isfinite(*value))
        throw relamp::Error(relamp::ErrorCode::malformed, fmt::format("\"{}\" is no number", word));
    return *value;
}

uint32_t wholeNumberOf(const std::string& word)
{
    const std::optional<uint32_t> value = wholeWord<uint32_t>(word);
    if (!value)
        throw relamp::Error(relamp::ErrorCode::malformed,
                            fmt::format("\"{}\" is no whole number from 0 to {}", word,
                                        std::numeric_limits<uint32_t>::max()));
    return *value;
}
