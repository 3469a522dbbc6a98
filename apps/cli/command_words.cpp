#include "command_words.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

namespace
{

/// How many letters have to be put in, taken out or replaced to make one of the other.
size_t slipsBetween(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// As a shell reads it as one word.
std::string quoted(const std::string& word)
{
    const auto isPlain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("._-/+=:@%,").find(c) != std::string_view::npos || c < 0;
    };
    if (std::all_of(word.begin(), word.end(), isPlain)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// Commands that take what the person named; empty where it is neither a scan nor a folder.
std::vector<std::string> commandsFor(const std::string& word)
{
    const std::filesystem::path path(word);
    std::error_code ignored;
    const std::string name = quoted(word);
    if (std::filesystem::exists(path / "report.json", ignored))
        return {fmt::format("relamp relight {} --fixture all=on -o again.png", name),
                fmt::format("relamp verify {}", name), fmt::format("relamp view {}", name)};
    if (!std::filesystem::is_regular_file(path, ignored) && !path.has_extension()) return {};
    return {fmt::format("relamp info {}", name),
            fmt::format("relamp delight {} -o {}", name, quoted(path.stem().string())),
            fmt::format("relamp view {}", name)};
}

} // namespace

std::vector<std::string> commandWords(int argc, const char* const* argv)
{
    std::vector<std::string> words(argv + 1, argv + argc);
    const bool asksForHelp = words.empty() || words.front() == "help";
    while (!words.empty() && words.front() == "help") words.erase(words.begin());
    if (asksForHelp) {
        words.resize(std::min<size_t>(words.size(), 1));
        words.emplace_back("--help");
    }
    return words;
}

std::string adviceOnCommand(const std::vector<std::string>& words, const CLI::App& app)
{
    constexpr size_t kMostSlips = 2;
    if (words.empty() || words.front().starts_with('-')) return "";
    const std::string& word = words.front();
    std::string known;
    std::string nearest;
    size_t slips = kMostSlips + 1;
    for (const CLI::App* command : app.get_subcommands({})) {
        const std::string& name = command->get_name();
        if (name == word) return "";
        known += (known.empty() ? "" : ", ") + name;
        if (const size_t n = slipsBetween(word, name); n < slips) {
            slips = n;
            nearest = name;
        }
    }
    std::string advice = fmt::format("\"{}\" is no command. ", word);
    if (const std::vector<std::string> meant = commandsFor(word); !meant.empty()) {
        advice += "Did you mean one of these?";
        for (const std::string& command : meant) advice += "\n  " + command;
    } else {
        advice += nearest.empty() ? fmt::format("There are {}.", known)
                                  : fmt::format("Did you mean relamp {}?", nearest);
    }
    return advice + "\nrelamp --help tells more.";
}
