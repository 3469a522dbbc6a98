#pragma once

#include "relamp/devices.h"
#include "relamp/names.h"
#include "relamp/scan.h"

#include <filesystem>
#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

/// What every command that reads a scan wants to know about it.
struct ScanArguments
{
    std::filesystem::path file;
    relamp::ScanOptions options;
    int threads = 0;
};

/// Takes numbers from `low` to `high`. CLI::Range would take NaN as well.
CLI::Validator between(double low, double high);

/// Takes the words of `values` for what they stand for, and no others.
template<class Value>
CLI::Validator oneOf(const std::map<std::string, Value>& values)
{
    std::string names; // under which command_table.cpp finds what there is to choose from
    for (const auto& [name, value] : values) names += ' ' + name;
    const auto take = [values](std::string& word) -> std::string {
        const auto found = values.find(word);
        if (found == values.end()) {
            std::string known;
            for (const auto& [name, value] : values) known += (known.empty() ? "" : ", ") + name;
            return fmt::format("\"{}\" is none of {}", word, known);
        }
        word = std::to_string(static_cast<int>(found->second)); // as CLI11 reads an enumeration
        return "";
    };
    return {take, "", "one of" + names};
}

/// Takes the names of an enumeration, relamp/names.h.
template<class Enum>
CLI::Validator oneOf()
{
    std::map<std::string, Enum> values;
    for (const char* name : relamp::Names<Enum>::all) values[name] = *relamp::named<Enum>(name);
    return oneOf(values);
}

/// Refuses the empty text for every option of `app` and its commands: a name that a script has
/// lost, which would else be as if the option were not there.
void refuseEmptyValues(CLI::App& app);

/// --engine and --gpu, which compute `what`.
void addEngineArguments(CLI::App& command, relamp::EngineOptions& engine, const std::string& what);

void addScanArguments(CLI::App& command, ScanArguments& arguments);
/// All of them but the scan itself.
void addReadingArguments(CLI::App& command, ScanArguments& arguments);
