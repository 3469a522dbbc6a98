#include "relamp/printable.h"

#include <array>
#include <vector>

#include <fmt/format.h>

namespace relamp
{
namespace
{

/// A character at the beginning of a text; `bytes` of it, 1 where it is no UTF-8.
struct Character
{
    char32_t code = 0;
    size_t bytes = 1;
    bool isValid = false;
};

Character firstOf(std::string_view text)
{
    const auto byteAt = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byteAt(0);
    if (lead < 0x80) return {lead, 1, true};
    const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    char32_t code = lead & (0x7fu >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((byteAt(i) & 0xc0u) != 0x80u) return {};
        code = (code << 6) | (byteAt(i) & 0x3fu);
    }
    constexpr std::array<char32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};
    const bool isSurrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < kSmallest[bytes] || code > 0x10ffff || isSurrogate) return {};
    return {code, bytes, true};
}

bool isBetween(char32_t code, char32_t first, char32_t last)
{
    return code >= first && code <= last;
}

/// Whether a terminal would do something else than draw it, or hide what stands beside it.
bool isCommand(char32_t code)
{
    const bool isControl = code < 0x20 || isBetween(code, 0x7f, 0x9f);
    const bool turns = code == 0x61c || isBetween(code, 0x200e, 0x200f) ||
                       isBetween(code, 0x202a, 0x202e) || isBetween(code, 0x2066, 0x2069);
    const bool isHidden = code == 0x200b || code == 0xfeff || isBetween(code, 0xe0000, 0xe007f);
    const bool endsLine = isBetween(code, 0x2028, 0x2029);
    return isControl || turns || isHidden || endsLine;
}

std::string escaped(std::string_view character, Character is)
{
    if (is.isValid && is.code > 0xffff)
        return fmt::format("\\U{:08x}", static_cast<uint32_t>(is.code));
    if (is.isValid && is.code > 0xff)
        return fmt::format("\\u{:04x}", static_cast<uint32_t>(is.code));
    return fmt::format("\\x{:02x}", is.isValid ? static_cast<unsigned>(is.code)
                                               : static_cast<unsigned char>(character[0]));
}

/// Characters of one line, each as it is shown, of no more than the first and last `most`.
std::vector<std::string> shown(std::string_view line, size_t most)
{
    constexpr size_t kMostBytes = 4; // of a character
    std::string ends; // what is left out lies in the middle of what is shown, and so is not
    if (line.size() > 2 * most * kMostBytes) {
        ends = std::string(line.substr(0, most * kMostBytes));
        ends += line.substr(line.size() - most * kMostBytes);
        line = ends;
    }
    std::vector<std::string> characters;
    while (!line.empty()) {
        const Character is = firstOf(line);
        const std::string_view character = line.substr(0, is.bytes);
        const bool isKept = is.isValid && !isCommand(is.code);
        characters.push_back(isKept ? std::string(character) : escaped(character, is));
        line.remove_prefix(is.bytes);
    }
    return characters;
}

/// A line of which no more than `head` and `tail` characters are left, where it has more.
std::string printable(std::string_view line, size_t head, size_t tail)
{
    const std::vector<std::string> characters = shown(line, head + tail);
    const bool isCut = characters.size() > head + tail;
    std::string text;
    for (size_t i = 0; i < characters.size(); ++i) {
        if (isCut && i == head) text += "...";
        if (!isCut || i < head || i >= characters.size() - tail) text += characters[i];
    }
    return text;
}

} // namespace

std::string printableName(std::string_view name, size_t most)
{
    return printable(name, most, 0);
}

std::string printableText(std::string_view text)
{
    constexpr int kMostLines = 20;
    // The beginning of a sentence names the file, and its end says the way out.
    constexpr size_t kHead = 600;
    constexpr size_t kTail = 300;
    std::string result;
    for (int line = 1; line < kMostLines && text.find('\n') != std::string_view::npos; ++line) {
        const size_t end = text.find('\n');
        result += printable(text.substr(0, end), kHead, kTail) + '\n';
        text.remove_prefix(end + 1);
    }
    return result + printable(text, kHead, kTail);
}

} // namespace relamp
