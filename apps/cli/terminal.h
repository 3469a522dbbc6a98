#pragma once

#include "relamp/progress.h"

#include <string>

enum class Talk {
    normal,
    quiet, // errors only
};

/// Draws progress on standard error: a bar where a person looks, plain lines elsewhere.
relamp::Progress::Sink progressDisplay(Talk talk);

/// Ends the bar's line, if there is one.
void endProgressDisplay(Talk talk);

/// "relamp: first line", the following lines indented under it, on standard error.
void printProblem(const std::string& sentence);
