#include "lights/fixture_named.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace relamp
{
namespace
{

constexpr size_t kMostListed = 40; // names in a sentence

bool areSame(std::string_view a, std::string_view b)
{
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

} // namespace

int fixtureIdAt(const JsonItem& item, const char* key)
{
    const nlohmann::json& value = *item.find(key);
    if (!value.is_number_unsigned() || value.get<uint64_t>() > kLargestFixtureId)
        item.refuse(fmt::format("\"{}\" is {}; it must be the number of a fixture, 0 to {}", key,
                                printable(value), kLargestFixtureId),
                    key);
    return value.get<int>();
}

size_t placeOfNamed(const Lights& lights, std::string_view numberOrName)
{
    int id = 0;
    const char* last = numberOrName.data() + numberOrName.size();
    const auto [end, error] = std::from_chars(numberOrName.data(), last, id);
    if (error == std::errc() && end == last) return lights.placeOf(id);
    size_t place = 0;
    while (place < lights.fixtures.size() && !areSame(lights.nameOf(place), numberOrName)) ++place;
    return place;
}

std::string namesOf(const Lights& lights)
{
    std::string names;
    for (size_t i = 0; i < std::min(lights.fixtures.size(), kMostListed); ++i)
        names += (i == 0 ? "" : ", ") + lights.nameOf(i);
    if (lights.fixtures.size() > kMostListed)
        names += fmt::format(" and {} more", lights.fixtures.size() - kMostListed);
    return names.empty() ? "none" : names;
}

} // namespace relamp
