#include "scan/ply_file.h"

#include "base/fail.h"
#include "scan/take_number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>

namespace relamp
{
namespace
{

constexpr size_t kLongestHeader = size_t{1} << 16; // bytes; real ones have some hundred

std::string_view text(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Takes the first word off `line`.
std::string_view takeWord(std::string_view& line)
{
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

std::string_view trimmed(std::string_view line)
{
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line.substr(0, line.find_last_not_of(" \t") + 1);
}

size_t sizeOf(PlyType type)
{
    constexpr std::array<size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<size_t>(type)];
}

template<class Number>
double load(const char* bytes, bool swap)
{
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes, raw.size());
    if (swap) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<Number>(raw));
}

double load(const char* bytes, PlyType type, bool swap)
{
    switch (type) {
    case PlyType::int8:
        return load<int8_t>(bytes, swap);
    case PlyType::uint8:
        return load<uint8_t>(bytes, swap);
    case PlyType::int16:
        return load<int16_t>(bytes, swap);
    case PlyType::uint16:
        return load<uint16_t>(bytes, swap);
    case PlyType::int32:
        return load<int32_t>(bytes, swap);
    case PlyType::uint32:
        return load<uint32_t>(bytes, swap);
    case PlyType::float32:
        return load<float>(bytes, swap);
    case PlyType::float64:
        return load<double>(bytes, swap);
    }
    return 0.0;
}

class HeaderParser
{
public:
    HeaderParser(std::string_view bytes, const std::string& name)
        : all_(bytes), rest_(bytes.substr(0, kLongestHeader)), name_(name)
    {}

    PlyHeader parse();

private:
    std::string_view nextLine();
    void takeFormat(std::string_view line);
    void takeElement(std::string_view line);
    void takeProperty(std::string_view line);
    void takeComment(std::string_view line);
    [[nodiscard]] PlyType typeFrom(std::string_view word) const;
    [[noreturn]] void failOnLine(const std::string& why) const
    {
        malformed(name_, fmt::format("line {} of its header {}", line_, why));
    }

    std::string_view all_;
    std::string_view rest_;
    std::string name_;
    size_t line_ = 0;
    bool hasFormat_ = false;
    PlyHeader header_;
};

std::string_view HeaderParser::nextLine()
{
    const size_t end = rest_.find_first_of("\r\n");
    if (end == std::string_view::npos)
        malformed(name_, "its PLY header has no end; the file is cut off or damaged");
    const std::string_view line = rest_.substr(0, end);
    const bool both = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(end + (both ? 2 : 1));
    ++line_;
    return line;
}

PlyType HeaderParser::typeFrom(std::string_view word) const
{
    constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};
    for (size_t i = 0; i < kNames.size(); ++i)
        if (word == kNames[i][0] || word == kNames[i][1]) return static_cast<PlyType>(i);
    failOnLine(fmt::format("has a type that PLY does not know: \"{}\"", word));
}

void HeaderParser::takeFormat(std::string_view line)
{
    const std::string_view encoding = takeWord(line);
    if (encoding == "ascii")
        header_.encoding = PlyEncoding::ascii;
    else if (encoding == "binary_little_endian")
        header_.encoding = PlyEncoding::littleEndian;
    else if (encoding == "binary_big_endian")
        header_.encoding = PlyEncoding::bigEndian;
    else
        failOnLine(fmt::format("has a format that PLY does not know: \"{}\"", encoding));
    if (const std::string_view version = takeWord(line); version != "1.0")
        failOnLine(fmt::format("says version \"{}\" of PLY; there is 1.0 alone", version));
    hasFormat_ = true;
}

void HeaderParser::takeElement(std::string_view line)
{
    PlyElement element;
    element.name = takeWord(line);
    const std::string_view count = takeWord(line);
    const auto [end, failure] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (failure != std::errc() || end != count.data() + count.size())
        failOnLine(fmt::format("says \"{}\" where a number of elements belongs", count));
    header_.elements.push_back(std::move(element));
}

void HeaderParser::takeProperty(std::string_view line)
{
    if (header_.elements.empty()) failOnLine("has a property of no element");
    PlyProperty property;
    std::string_view type = takeWord(line);
    if (type == "list") {
        property.countType = typeFrom(takeWord(line));
        if (property.countType >= PlyType::float32) failOnLine("counts a list in fractions");
        type = takeWord(line);
    }
    property.type = typeFrom(type);
    property.name = takeWord(line);
    header_.elements.back().properties.push_back(std::move(property));
}

void HeaderParser::takeComment(std::string_view line)
{
    if (takeWord(line) == "TextureFile") header_.textureFiles.emplace_back(trimmed(line));
}

PlyHeader HeaderParser::parse()
{
    if (trimmed(nextLine()) != "ply") failOnLine("is not \"ply\"");
    while (true) {
        std::string_view line = nextLine();
        const std::string_view keyword = takeWord(line);
        if (keyword == "end_header") break;
        if (keyword == "format")
            takeFormat(line);
        else if (keyword == "element")
            takeElement(line);
        else if (keyword == "property")
            takeProperty(line);
        else if (keyword == "comment")
            takeComment(line);
        else if (keyword != "obj_info" && !keyword.empty())
            failOnLine(fmt::format("begins with a word that PLY does not know: \"{}\"", keyword));
    }
    if (!hasFormat_) malformed(name_, "its header has no line \"format\"; export it again");
    header_.size = static_cast<size_t>(rest_.data() - all_.data());
    return std::move(header_);
}

} // namespace

PlyHeader parsePlyHeader(std::span<const std::byte> bytes, const std::string& name)
{
    return HeaderParser(text(bytes), name).parse();
}

double largestOf(PlyType type)
{
    switch (type) {
    case PlyType::int8:
        return std::numeric_limits<int8_t>::max();
    case PlyType::uint8:
        return std::numeric_limits<uint8_t>::max();
    case PlyType::int16:
        return std::numeric_limits<int16_t>::max();
    case PlyType::uint16:
        return std::numeric_limits<uint16_t>::max();
    case PlyType::int32:
        return std::numeric_limits<int32_t>::max();
    case PlyType::uint32:
        return std::numeric_limits<uint32_t>::max();
    default:
        return 1.0;
    }
}

PlyBody::PlyBody(std::span<const std::byte> body, PlyEncoding encoding, const std::string& name)
    : rest_(text(body)), encoding_(encoding), name_(name)
{}

void PlyBody::endsTooEarly() const
{
    malformed(name_, "ends before all that its header announces; copy or export it again");
}

double PlyBody::nextWord()
{
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    if (rest_.empty()) endsTooEarly();
    if (const auto number = takeNumber(rest_)) return *number;
    malformed(name_, fmt::format("has \"{}\" where a number belongs",
                                 rest_.substr(0, rest_.find_first_of(" \t\r\n")).substr(0, 20)));
}

double PlyBody::next(PlyType type)
{
    if (encoding_ == PlyEncoding::ascii) return nextWord();
    const size_t size = sizeOf(type);
    if (rest_.size() < size) endsTooEarly();
    constexpr bool kLittle = std::endian::native == std::endian::little;
    const double value =
        load(rest_.data(), type, (encoding_ == PlyEncoding::littleEndian) != kLittle);
    rest_.remove_prefix(size);
    return value;
}

void PlyBody::next(const PlyProperty& property, std::vector<double>& values)
{
    values.clear();
    const double count = property.countType ? next(*property.countType) : 1.0;
    if (!(count >= 0.0 && count <= static_cast<double>(rest_.size()))) endsTooEarly();
    for (auto i = static_cast<size_t>(count); i > 0; --i) values.push_back(next(property.type));
}

void PlyBody::expectEnd() const
{
    constexpr std::string_view kPadding(" \t\r\n\0", 5);
    if (rest_.find_first_not_of(kPadding) != std::string_view::npos)
        malformed(
            name_,
            fmt::format("goes on for {} bytes behind all that its header announces; the counts "
                        "in its header are wrong. Export it again",
                        rest_.size()));
}

void PlyBody::expect(const PlyElement& element) const
{
    size_t least = 0; // bytes a row
    for (const PlyProperty& property : element.properties)
        least += encoding_ == PlyEncoding::ascii
                     ? 2
                     : sizeOf(property.countType.value_or(property.type));
    if (element.count >
        (rest_.size() + 1) / std::max<size_t>(least, 1)) // the last word needs no space behind it
        malformed(name_,
                  fmt::format(
                      "announces {} of element \"{}\", but only {} bytes are left; the file is cut "
                      "off or damaged",
                      element.count, element.name, rest_.size()));
}

} // namespace relamp
