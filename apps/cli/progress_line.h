#pragma once

#include <string>
#include <string_view>

/// "  bounce       [########      ]  60 %" in at most `columns` - 1 characters, so that no terminal
/// breaks the line. Where all does not fit, the bar gets shorter, then goes, then the name gets
/// shorter. 0 columns, as some terminals say that they have, are 80. `fraction` is kept to 0..1.
std::string progressLine(std::string_view name, double fraction, int columns);
