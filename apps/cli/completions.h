#pragma once

#include "command_table.h"

/// Writes relamp for bash, _relamp for zsh and relamp.fish. False where that cannot be.
bool writeCompletions(const CommandTable& table, const std::string& folder);
