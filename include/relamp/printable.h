#pragma once

#include "relamp/api.h"

#include <string>
#include <string_view>

namespace relamp
{

constexpr size_t kPrintedName = 200; // characters of a name in a sentence

/// A name of a file's or of a person's, as it may stand in a sentence: on one line, of no more than
/// `most` characters, without anything that a terminal obeys. Control characters, what turns the
/// direction of writing, and bytes that are no UTF-8 are told as \x1b or \u202e; all else stays.
RELAMP_API std::string printableName(std::string_view name, size_t most = kPrintedName);

/// The same of whole sentences, whose line ends stay. Of a line that is longer than any of relamp's
/// own the middle is left out, for the beginning names the file and the end says the way out. Error
/// does this with its own.
RELAMP_API std::string printableText(std::string_view text);

} // namespace relamp
