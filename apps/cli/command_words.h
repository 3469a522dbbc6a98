#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// What a person typed, as the command line is read: nothing and "help" are --help, "help delight"
/// is "delight --help".
std::vector<std::string> commandWords(int argc, const char* const* argv);

/// What to say where the first word is no command of `app`, with what was meant where that can be
/// told from a scan, a result's folder or a slip of the finger; empty where it is one, or an
/// option.
std::string adviceOnCommand(const std::vector<std::string>& words, const CLI::App& app);
