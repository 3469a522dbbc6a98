#pragma once

#include "relamp/devices.h"
#include "relamp/scan.h"

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

/// What every command that reads a scan wants to know about it.
struct ScanArguments
{
    std::filesystem::path file;
    relamp::ScanOptions options;
    int threads = 0;
};

/// Takes numbers from `low` to `high`. CLI::Range would take NaN as well.
CLI::Validator between(double low, double high);

/// --engine and --gpu, which compute `what`.
void addEngineArguments(CLI::App& command, relamp::EngineOptions& engine, const std::string& what);

void addScanArguments(CLI::App& command, ScanArguments& arguments);
