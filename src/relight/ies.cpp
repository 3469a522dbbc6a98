#include "relight/ies.h"

#include "base/fail.h"
#include "base/file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kLargestFile = size_t{16} << 20;
constexpr size_t kMostAngles = 10000;                    // of a kind; a fine measurement has 361
constexpr double kLargestCandela = 1e12;                 // a lighthouse has 1e7
constexpr double kSmallestStep = 1e-3;                   // degrees, from an angle to the next
constexpr double kAngleTolerance = 0.01;                 // degrees; files round
constexpr std::string_view kBlanks = " \t\r\n,\f\v\x1a"; // and the end of file of old systems

/// The numbers of the file from TILT on, and where they stand.
class Numbers
{
public:
    Numbers(std::string_view text, size_t line, const std::string& name)
        : rest_(text), line_(line), name_(name)
    {}

    /// The next one; `what` it is stands in the sentence where there is none.
    double next(const char* what)
    {
        skipBlanks();
        if (rest_.empty())
            malformed(name_, fmt::format("ends before {}; the file is not whole", what));
        const size_t length = std::min(rest_.find_first_of(kBlanks), rest_.size());
        std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failure != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            malformed(name_, fmt::format("line {}: \"{}\" is no number, and should be {}", line_,
                                         printable(word), what));
        return value;
    }

    double nextBetween(double low, double high, const char* what)
    {
        const double value = next(what);
        if (!(value >= low && value <= high))
            malformed(name_, fmt::format("line {}: {} is {}; it must be {} to {}", line_, what,
                                         value, low, high));
        return value;
    }

    size_t nextCount(size_t most, const char* what)
    {
        const double value = nextBetween(1.0, static_cast<double>(most), what);
        if (value != std::floor(value))
            malformed(name_, fmt::format("line {}: {} is {}; it must be a whole number", line_,
                                         what, value));
        return static_cast<size_t>(value);
    }

    [[nodiscard]] size_t line() const { return line_; }

private:
    void skipBlanks()
    {
        const size_t blanks = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
        line_ += static_cast<size_t>(
            std::count(rest_.begin(), rest_.begin() + static_cast<ptrdiff_t>(blanks), '\n'));
        rest_.remove_prefix(blanks);
    }

    /// A word of unknown bytes as it may stand in a sentence.
    static std::string printable(std::string_view word)
    {
        std::string text(word.substr(0, 20));
        for (char& c : text)
            if (c < ' ' || c > '~') c = '?';
        return text;
    }

    std::string_view rest_;
    size_t line_;
    const std::string& name_;
};

bool startsWith(std::string_view line, std::string_view upperCase)
{
    if (line.size() < upperCase.size()) return false;
    return std::equal(upperCase.begin(), upperCase.end(), line.begin(), [](char a, char b) {
        return a == (b >= 'a' && b <= 'z' ? static_cast<char>(b - 'a' + 'A') : b);
    });
}

std::string_view trimmed(std::string_view line)
{
    const size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return line.substr(begin, line.find_last_not_of(kBlanks) - begin + 1);
}

/// What stands before the numbers: labels for people, up to the line "TILT=".
struct Head
{
    size_t lines = 0;      // with the one of TILT
    std::string_view tilt; // NONE, INCLUDE, or the name of a file
    std::string_view rest;
};

Head headOf(std::string_view text, const std::string& name)
{
    Head head;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        ++head.lines;
        if (!startsWith(line, "TILT")) continue;
        const size_t equals = line.find('=');
        if (equals == std::string_view::npos) continue;
        head.tilt = trimmed(line.substr(equals + 1));
        head.rest = text;
        return head;
    }
    malformed(name, "is no IES file: it has no line TILT=");
}

/// Factors on a lamp that hangs at an angle: read, and not needed, as it hangs as it was measured.
void passTilt(std::string_view tilt, Numbers& numbers)
{
    if (!startsWith(tilt, "INCLUDE")) return; // a file of its own says the same
    numbers.next("the geometry of its tilted lamp");
    const size_t pairs = numbers.nextCount(kMostAngles, "the number of its tilt angles");
    for (size_t i = 0; i < 2 * pairs; ++i) numbers.next("a tilt angle or its factor");
}

/// The line of the luminaire, as far as it matters here.
struct Luminaire
{
    double factor = 1.0; // of all candelas
    size_t verticals = 0;
    size_t horizontals = 0;
};

Luminaire luminaireFrom(Numbers& numbers, const std::string& name)
{
    Luminaire luminaire;
    numbers.next("the number of lamps");
    numbers.next("the lumens of a lamp");
    luminaire.factor = numbers.nextBetween(0.0, 1e6, "the multiplier of the candelas");
    luminaire.verticals = numbers.nextCount(kMostAngles, "the number of vertical angles");
    luminaire.horizontals = numbers.nextCount(kMostAngles, "the number of horizontal angles");
    const size_t type = numbers.nextCount(3, "the photometric type");
    if (type != 1)
        fail(
            ErrorCode::unsupported, name,
            fmt::format("is photometry of Type {}; relamp reads Type C, which luminaires for rooms "
                        "have",
                        type == 2 ? 'B' : 'A'));
    numbers.next("the unit of its size");
    for (const char* what : {"its width", "its length", "its height"}) numbers.next(what);
    luminaire.factor *= numbers.nextBetween(0.0, 1e6, "the ballast factor");
    numbers.next("the ballast-lamp factor");
    numbers.next("the input watts");
    return luminaire;
}

/// Ascending angles in degrees.
std::vector<double> anglesFrom(Numbers& numbers, size_t count, double highest, const char* what,
                               const std::string& name)
{
    std::vector<double> angles(count);
    for (double& angle : angles)
        angle = numbers.nextBetween(-kAngleTolerance, highest + kAngleTolerance, what);
    const auto isNoStep = [](double a, double b) { return b - a < kSmallestStep; };
    if (std::adjacent_find(angles.begin(), angles.end(), isNoStep) != angles.end())
        malformed(name, fmt::format("line {}: the list of which {} is one must ascend",
                                    numbers.line(), what));
    return angles;
}

bool isNear(double angle, double other)
{
    return std::abs(angle - other) <= kAngleTolerance;
}

void checkHorizontals(const std::vector<double>& angles, const std::string& name)
{
    const double first = angles.front();
    const double last = angles.back();
    const bool fromZero = isNear(first, 0.0) && (isNear(last, 0.0) || isNear(last, 90.0) ||
                                                 last >= 180.0 - kAngleTolerance);
    const bool fromSide = isNear(first, 90.0) && isNear(last, 270.0);
    if (!fromZero && !fromSide)
        malformed(name, fmt::format("its horizontal angles go from {} to {}; they must go from 0 "
                                    "to 0, 90, 180 or 360, or from 90 to 270",
                                    first, last));
}

/// The measured row for every horizontal angle of the full circle, degrees in [0, 360).
using Turn = std::map<double, size_t>;

Turn fullTurn(const std::vector<double>& horizontals)
{
    const double first = horizontals.front();
    const double last = horizontals.back();
    Turn rows;
    for (size_t row = 0; row < horizontals.size(); ++row) {
        const double angle = horizontals[row];
        std::vector<double> alike{angle};
        if (isNear(first, 90.0)) // the other side mirrors it
            alike.push_back(540.0 - angle);
        else if (last <= 180.0 + kAngleTolerance && !isNear(last, 0.0))
            alike.push_back(360.0 - angle);
        if (isNear(last, 90.0))
            for (const double half : {180.0 - angle, 180.0 + angle}) alike.push_back(half);
        for (const double other : alike) // the first wins: 360 is 0 again
            rows.try_emplace(std::round(std::fmod(other + 360.0, 360.0) * 1e3) / 1e3, row);
    }
    rows.erase(360.0);
    return rows;
}

/// Integral of a linear function of the angle, a at t0 and b at t1, times its sine.
double zone(double t0, double t1, double a, double b)
{
    if (t1 <= t0) return 0.0; // rounded to the same
    const double slope = (b - a) / (t1 - t0);
    return a * std::cos(t0) - b * std::cos(t1) + slope * (std::sin(t1) - std::sin(t0));
}

/// The integral of a profile over the sphere, linear between its angles.
double lumensOf(const LightProfile& profile)
{
    const size_t rows = profile.horizontal.size();
    const size_t columns = profile.vertical.size();
    double sum = 0.0;
    for (size_t row = 0; row < rows; ++row) {
        const double before = profile.horizontal[(row + rows - 1) % rows];
        const double after = profile.horizontal[(row + 1) % rows];
        double width = 0.5 * (after - before); // of the wedge that this row stands for
        if (rows == 1) width = glm::two_pi<double>();
        if (rows > 1 && width <= 0.0) width += glm::pi<double>();
        for (size_t i = 0; i + 1 < columns; ++i)
            sum +=
                width * zone(profile.vertical[i], profile.vertical[i + 1],
                             profile.gain[row * columns + i], profile.gain[row * columns + i + 1]);
    }
    return sum;
}

/// A profile of the full circle of what was measured: `candelas` has a row a horizontal angle.
LightProfile profileOf(const std::vector<double>& verticals, const std::vector<double>& horizontals,
                       const std::vector<float>& candelas)
{
    constexpr double kEdge = 0.01; // degrees in which a luminaire that shines up alone goes dark
    const bool startsDark = verticals.front() > kEdge;
    LightProfile profile;
    if (startsDark)
        profile.vertical.push_back(static_cast<float>(glm::radians(verticals.front() - kEdge)));
    for (const double angle : verticals)
        profile.vertical.push_back(static_cast<float>(glm::radians(std::max(angle, 0.0))));
    for (const auto& [angle, row] : fullTurn(horizontals)) {
        profile.horizontal.push_back(static_cast<float>(glm::radians(angle)));
        if (startsDark) profile.gain.push_back(0.0f);
        const auto begin = candelas.begin() +
                           static_cast<ptrdiff_t>(row) * static_cast<ptrdiff_t>(verticals.size());
        profile.gain.insert(profile.gain.end(), begin,
                            begin + static_cast<ptrdiff_t>(verticals.size()));
    }
    return profile;
}

} // namespace

IesPhotometry parseIes(std::span<const std::byte> text, const std::string& name)
{
    const Head head = headOf({reinterpret_cast<const char*>(text.data()), text.size()}, name);
    Numbers numbers(head.rest, head.lines + 1, name);
    passTilt(head.tilt, numbers);
    const Luminaire luminaire = luminaireFrom(numbers, name);
    const auto verticals =
        anglesFrom(numbers, luminaire.verticals, 180.0, "a vertical angle", name);
    const auto horizontals =
        anglesFrom(numbers, luminaire.horizontals, 360.0, "a horizontal angle", name);
    checkHorizontals(horizontals, name);
    std::vector<float> candelas;
    for (size_t i = 0; i < verticals.size() * horizontals.size(); ++i) {
        const double candela =
            numbers.nextBetween(-kLargestCandela, kLargestCandela, "a candela value");
        candelas.push_back(static_cast<float>( // noise of the measurement may be below 0
            std::min(luminaire.factor * std::max(candela, 0.0), kLargestCandela)));
    }

    LightProfile profile = profileOf(verticals, horizontals, candelas);
    IesPhotometry photometry;
    photometry.peak = *std::max_element(candelas.begin(), candelas.end());
    photometry.lumens = static_cast<float>(lumensOf(profile));
    if (!(photometry.lumens > 0.0f)) malformed(name, "gives no light: its candelas are 0");
    photometry.profile = std::make_shared<const LightProfile>(std::move(profile));
    return photometry;
}

IesPhotometry readIes(const std::filesystem::path& file)
{
    return parseIes(readFile(file, kLargestFile), file.string());
}

} // namespace relamp
