#pragma once

#include <functional>

#include <CLI/CLI.hpp>

/// What a subcommand's own code does once the command line is read; returns the exit code.
using Run = std::function<int()>;

/// Each adds one subcommand to `app` and sets `run` when the person chose it.
void addBenchCommand(CLI::App& app, Run& run);
void addDelightCommand(CLI::App& app, Run& run);
void addDevicesCommand(CLI::App& app, Run& run);
void addInfoCommand(CLI::App& app, Run& run);
void addPageCommand(CLI::App& app, Run& run);
void addRelightCommand(CLI::App& app, Run& run);
void addVerifyCommand(CLI::App& app, Run& run);
void addViewCommand(CLI::App& app, Run& run);
