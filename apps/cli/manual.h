#pragma once

#include "command_table.h"

/// Writes relamp.1, which holds the text of the file `beyond` too, and relamp-COMMAND.1 for each
/// command. False where a file cannot be read or written.
bool writeManual(const CommandTable& table, const std::string& folder, const std::string& beyond);
