#pragma once

#include "relamp/relight.h"

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// Which light a person wants in a room: --lights and --fixture.
struct LightArguments
{
    std::filesystem::path file;        // empty: none
    std::string piped;                 // its text, where that is -
    std::vector<std::string> fixtures; // what is said of them

    [[nodiscard]] bool areGiven() const { return !file.empty() || !fixtures.empty(); }
    /// Reads standard input where that is the file.
    void readPipe();
    /// What was asked for; of no file `otherwise`, with what is said of fixtures.
    [[nodiscard]] relamp::Relighting in(const relamp::Lights& captured,
                                        relamp::Relighting otherwise,
                                        std::vector<std::string>& warnings) const;
};

/// `ofFile` and `ofFixtures` are what the command does with them.
void addLightArguments(CLI::App& command, LightArguments& arguments, const std::string& ofFile,
                       const std::string& ofFixtures);
