#include "output/usd_text.h"

#include "base/fail.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr size_t kBuffer = size_t{1} << 20; // bytes
constexpr size_t kLongestNumber = 16;       // "-1.17549435e-38"
constexpr std::string_view kNotUtf8 = "\xef\xbf\xbd";

bool isWord(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Bytes of the character that a text begins with; 0 where it is no UTF-8.
size_t lengthOfCharacter(std::string_view text)
{
    const auto at = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
    const uint8_t first = at(0);
    const size_t length = first < 0x80   ? 1
                          : first < 0xc2 ? 0
                          : first < 0xe0 ? 2
                          : first < 0xf0 ? 3
                          : first < 0xf5 ? 4
                                         : 0;
    if (length == 0 || length > text.size()) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((at(i) & 0xc0) != 0x80) return 0;
    const bool isOverlong = (first == 0xe0 && at(1) < 0xa0) || (first == 0xf0 && at(1) < 0x90);
    const bool isNone = (first == 0xed && at(1) > 0x9f) || (first == 0xf4 && at(1) > 0x8f);
    return isOverlong || isNone ? 0 : length;
}

/// One character of ASCII between quotes.
std::string escaped(char c)
{
    if (c == '"' || c == '\\') return {'\\', c};
    if (c == '\n') return "\\n";
    if (c == '\t') return "\\t";
    const auto code = static_cast<uint8_t>(c);
    return code < 0x20 || code == 0x7f ? fmt::format("\\x{:02x}", code) : std::string(1, c);
}

} // namespace

std::string primName(std::string_view name)
{
    std::string word;
    for (const char c : name) {
        if ((static_cast<uint8_t>(c) & 0xc0) == 0x80) continue; // goes on with a character
        word += isWord(c) ? c : '_';
    }
    if (word.find_first_not_of('_') == std::string::npos) return "unnamed";
    return word.front() >= '0' && word.front() <= '9' ? "_" + word : word;
}

std::string PrimNames::take(std::string_view name)
{
    const std::string word = primName(name);
    std::string unique = word;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = fmt::format("{}_{}", word, i);
    return unique;
}

std::string usdString(std::string_view text)
{
    std::string all = "\"";
    while (!text.empty()) {
        const size_t length = lengthOfCharacter(text);
        if (length == 0)
            all += kNotUtf8;
        else if (length == 1)
            all += escaped(text.front());
        else
            all += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return all + '"';
}

std::string usd(float value)
{
    assert(std::isfinite(value));
    std::array<char, kLongestNumber> digits{};
    const auto [end, failure] = std::to_chars(digits.begin(), digits.end(), value + 0.0f); // no -0
    assert(failure == std::errc());
    return {digits.begin(), end};
}

std::string usd(glm::vec3 value)
{
    return fmt::format("({}, {}, {})", usd(value.x), usd(value.y), usd(value.z));
}

UsdText::UsdText(const std::filesystem::path& file)
    : file_(file), stream_(std::fopen(file.c_str(), "wb"))
{
    if (!stream_) cannotWrite(file_, std::strerror(errno));
    buffer_.reserve(kBuffer);
}

void UsdText::put(std::string_view text)
{
    if (buffer_.size() + text.size() > kBuffer) flush();
    buffer_ += text;
}

void UsdText::put(float value)
{
    assert(std::isfinite(value));
    std::array<char, kLongestNumber> digits{};
    const char* end = std::to_chars(digits.begin(), digits.end(), value + 0.0f).ptr;
    put(std::string_view(digits.begin(), end));
}

void UsdText::put(unsigned value)
{
    std::array<char, kLongestNumber> digits{};
    const char* end = std::to_chars(digits.begin(), digits.end(), value).ptr;
    put(std::string_view(digits.begin(), end));
}

void UsdText::flush()
{
    if (std::fwrite(buffer_.data(), 1, buffer_.size(), stream_.get()) != buffer_.size())
        cannotWrite(file_, std::strerror(errno));
    buffer_.clear();
}

void UsdText::begin(std::string_view text)
{
    for (size_t i = 0; i < depth_; ++i) put("    ");
    put(text);
}

void UsdText::line(std::string_view text)
{
    begin(text);
    put("\n");
}

void UsdText::open(std::string_view text)
{
    line(text);
    line("{");
    ++depth_;
}

void UsdText::openHere(std::string_view text)
{
    begin(text);
    put(" {\n");
    ++depth_;
}

void UsdText::close()
{
    --depth_;
    line("}");
}

template<class Vector>
void UsdText::tuples(std::string_view head, std::span<const Vector> values)
{
    begin(head);
    put(" = [");
    const char* before = "(";
    for (const Vector& value : values) {
        for (int i = 0; i < Vector::length(); ++i) {
            put(before);
            put(value[i]);
            before = ", ";
        }
        put(")");
        before = ", (";
    }
    put("]\n");
}

void UsdText::array(std::string_view head, std::span<const glm::vec3> values)
{
    tuples(head, values);
}

void UsdText::array(std::string_view head, std::span<const glm::vec2> values)
{
    tuples(head, values);
}

void UsdText::array(std::string_view head, std::span<const glm::uvec3> values)
{
    begin(head);
    put(" = [");
    const char* before = "";
    for (const glm::uvec3& value : values)
        for (int i = 0; i < 3; ++i) {
            put(before);
            put(value[i]);
            before = ", ";
        }
    put("]\n");
}

void UsdText::array(std::string_view head, size_t count, int value)
{
    begin(head);
    put(" = [");
    const std::string one = fmt::format("{}", value);
    for (size_t i = 0; i < count; ++i) {
        if (i > 0) put(", ");
        put(one);
    }
    put("]\n");
}

void UsdText::interpolation(std::string_view how)
{
    assert(!buffer_.empty() && buffer_.back() == '\n');
    buffer_.pop_back();
    put(" (\n");
    ++depth_;
    line(fmt::format("interpolation = \"{}\"", how));
    --depth_;
    line(")");
}

void UsdText::finish()
{
    flush();
    if (std::fclose(stream_.release()) != 0) cannotWrite(file_, std::strerror(errno));
}

} // namespace relamp
