#include "fuzz/grown.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace relamp::fuzz
{
namespace
{

constexpr size_t kLargest = size_t{4} << 20; // bytes of JSON, which take a sanitized parser seconds

/// Where the string is closed that is opened at `at`.
size_t endOfString(std::string_view json, size_t at)
{
    for (++at; at < json.size() && json[at] != '"'; ++at)
        if (json[at] == '\\') ++at;
    return at;
}

/// The elements of all lists, innermost first. What is no JSON gives some, too.
std::vector<std::string_view> elementsOf(std::string_view json)
{
    struct Open
    {
        bool isList;
        size_t begin; // of its element
    };
    std::vector<Open> open;
    std::vector<std::string_view> elements;
    for (size_t at = 0; at < json.size(); ++at) {
        const char c = json[at];
        if (c == '"') at = endOfString(json, at);
        if (c == '[' || c == '{') open.push_back({c == '[', at + 1});
        if (open.empty() || (c != ',' && c != ']' && c != '}')) continue;
        if (open.back().isList)
            elements.push_back(json.substr(open.back().begin, at - open.back().begin));
        open.back().begin = at + 1;
        if (c != ',') open.pop_back();
    }
    return elements;
}

std::string repeated(std::string_view element, size_t times)
{
    std::string list;
    uint64_t number = 0;
    const char* end = element.data() + element.size();
    const bool counts = std::from_chars(element.data(), end, number).ptr == end && !element.empty();
    for (size_t i = 0; i < times && list.size() < kLargest; ++i) {
        if (i > 0) list += ',';
        list += counts ? std::to_string(number + i) : std::string(element);
    }
    return list;
}

} // namespace

size_t Growth::times() const
{
    return static_cast<size_t>(std::exp2(20.0 * std::pow(size / 255.0, 3.0)));
}

Growth growthFrom(std::span<const uint8_t> bytes)
{
    return {static_cast<uint16_t>(bytes[0] + (bytes[1] << 8)), bytes[2], bytes[3] % 4 == 0};
}

std::string grown(std::string_view json, std::span<const uint8_t> growths)
{
    std::string text(json);
    growths = growths.first(std::min(growths.size(), Growth::kMost * Growth::kBytes));
    for (; growths.size() >= Growth::kBytes; growths = growths.subspan(Growth::kBytes)) {
        const Growth growth = growthFrom(growths);
        const std::vector<std::string_view> elements = elementsOf(text);
        if (elements.empty()) return text;
        const std::string_view element = elements[growth.element % elements.size()];
        const std::string many = growth.isNested
                                     ? std::string(growth.times(), '[') + std::string(element) +
                                           std::string(growth.times(), ']')
                                     : repeated(element, growth.times());
        if (text.size() + many.size() > kLargest) return text;
        text.replace(static_cast<size_t>(element.data() - text.data()), element.size(), many);
    }
    return text;
}

} // namespace relamp::fuzz
