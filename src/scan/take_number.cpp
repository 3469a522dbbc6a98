#include "scan/take_number.h"

#include <charconv>
#include <limits>

namespace relamp
{

std::optional<double> takeNumber(std::string_view& text)
{
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure == std::errc::invalid_argument) return {};
    const std::string_view word = text.substr(0, static_cast<size_t>(end - text.data()));
    text.remove_prefix(word.size());
    if (failure != std::errc::result_out_of_range) return value;
    const bool isSmall = word.find("e-") < word.size() || word.find("E-") < word.size();
    return isSmall ? 0.0 : std::numeric_limits<double>::infinity(); // `value` is as it was
}

} // namespace relamp
