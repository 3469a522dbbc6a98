#pragma once

#include <optional>
#include <string_view>

namespace relamp
{

/// Takes the number that `text` begins with off it, whatever the locale; "nan" and "inf" are
/// numbers, too large ones infinite, too small ones 0. None where there is another word.
std::optional<double> takeNumber(std::string_view& text);

} // namespace relamp
