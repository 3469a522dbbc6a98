#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// One line of a script, split into words.
struct ScriptCommand
{
    size_t line = 0; // from 1
    std::string name;
    std::vector<std::string> words; // behind the name
};

/// What a script may say, for its own page and for people who mistype.
struct ScriptWord
{
    const char* name;
    size_t fewest; // words behind it
    size_t most;
    const char* usage;
};

/// A script that drives the viewer instead of a person; docs/guide/viewer.md describes it.
///
/// A line is a command, `#` begins a comment, "quotes" hold a word with spaces together. Throws
/// relamp::Error naming `name` and the line.
std::vector<ScriptCommand> parseScript(std::string_view text, const std::string& name);
std::vector<ScriptCommand> readScript(const std::filesystem::path& file);

/// A number that a script gives. Throws relamp::Error with a sentence that names the word.
float numberOf(const std::string& word);
/// From 0 to 4294967295.
uint32_t wholeNumberOf(const std::string& word);
