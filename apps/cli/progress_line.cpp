#include "progress_line.h"

#include <algorithm>

#include <fmt/format.h>

std::string progressLine(std::string_view name, double fraction, int columns)
{
    constexpr size_t kUsualColumns = 80;
    constexpr size_t kLongestBar = 30;
    constexpr size_t kShortestBar = 5;
    constexpr size_t kUsualName = 12; // so that bars of several stages begin at one place
    constexpr size_t kPercent = 6;    // " 100 %"
    constexpr size_t kFrame = 5;      // two blanks, a third, and brackets

    const double done = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
    const std::string percent = fmt::format(" {:3.0f} %", 100.0 * done);
    const size_t room = (columns > 0 ? static_cast<size_t>(columns) : kUsualColumns) - 1;
    const size_t width = std::max(name.size(), kUsualName);
    if (room < kFrame + width + kShortestBar + kPercent) {
        const size_t rest = room > kPercent ? room - kPercent : 0;
        const std::string line =
            rest > name.size() + 2 ? fmt::format("  {}", name) : std::string(name.substr(0, rest));
        return (line + percent).substr(0, room);
    }
    const size_t bar = std::min(kLongestBar, room - kFrame - width - kPercent);
    const std::string filled(static_cast<size_t>(done * static_cast<double>(bar)), '#');
    return fmt::format("  {:<{}} [{:<{}}]{}", name, width, filled, bar, percent);
}
