#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// An option, or a positional argument, which has no names.
struct OptionRow
{
    std::vector<std::string> names; // with their dashes
    std::string value;              // what stands for it in the help; empty for a flag
    std::string what;
    std::vector<std::string> choices; // empty where any value may be given
    bool isRequired = false;
    bool isRepeatable = false;

    bool takesFile() const;
};

struct CommandRow
{
    std::string name;
    std::string what;
    std::string examples;
    std::vector<OptionRow> options;
    std::vector<OptionRow> arguments;
};

/// The command line as CLI11 reads it, of which the man pages and completions are written.
struct CommandTable
{
    CommandRow program;
    std::vector<CommandRow> commands;
};

CommandTable commandTable(const CLI::App& app);

/// `text` with `escape` before each of the characters `special`.
std::string escaped(const std::string& text, const std::string& special, const std::string& escape);

/// Writes `text` to the file `path`; false where that cannot be.
bool writeText(const std::string& path, const std::string& text);
