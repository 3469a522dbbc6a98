#pragma once

#include "relamp/printable.h"
#include "relamp/progress.h"

#include <string>
#include <utility>

#include <fmt/format.h>

enum class Talk {
    normal,
    quiet, // errors only
    lines, // progress as "  stage 45 %" wherever it goes, for a program to read
};

/// Draws progress on standard error: a bar where a person looks, plain lines elsewhere, and where
/// they are asked for lines that say how far the stage is.
relamp::Progress::Sink progressDisplay(Talk talk);

/// Ends the bar's line, if there is one.
void endProgressDisplay(Talk talk);

/// Prints what is only said beside the work, to standard output. A terminal obeys nothing that is
/// in it, and where nobody hears it, the work is done all the same.
void printAside(const std::string& text);

/// "relamp: first line", the following lines indented under it, on standard error. A terminal obeys
/// nothing that is in it.
void printProblem(const std::string& sentence);

/// Text on standard output, as it is. For JSON, which a program reads, and for help, which is ours.
void printExactly(const std::string& text);

/// Text for people on standard output: a terminal obeys nothing that is in it. Everything that the
/// program says there goes this way, for names are those of other people's files.
template<class... Args>
void printOut(fmt::format_string<Args...> format, Args&&... args)
{
    printExactly(relamp::printableText(fmt::format(format, std::forward<Args>(args)...)));
}
