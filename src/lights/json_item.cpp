#include "lights/json_item.h"

#include "base/fail.h"
#include "base/json.h"
#include "relamp/printable.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr double kLargestNumber = 1e9; // of any unit; its square is still a float

/// A bound as a person writes it: 1e9, not 1e+09.
std::string asWritten(double bound)
{
    std::string text = fmt::format("{:g}", bound);
    for (const char* padding : {"+0", "+"})
        if (const size_t at = text.find(padding); at != std::string::npos)
            text.erase(at, std::string_view(padding).size());
    return text;
}

double numberFrom(const json& value, const JsonItem& item, const char* key, double low, double high)
{
    if (!value.is_number()) item.refuse(fmt::format("\"{}\": must be a number", key), key);
    const auto number = value.get<double>();
    if (!(number >= low && number <= high))
        item.refuse(fmt::format("\"{}\": must be a number between {} and {}", key, asWritten(low),
                                asWritten(high)),
                    key);
    return number;
}

float numberFrom(const json& value, const JsonItem& item, const char* key)
{
    return static_cast<float>(numberFrom(value, item, key, -kLargestNumber, kLargestNumber));
}

glm::vec3 vectorFrom(const json& value, const JsonItem& item, const char* key)
{
    if (!value.is_array() || value.size() != 3)
        item.refuse(fmt::format("\"{}\": must be a list of three numbers", key), key);
    return {numberFrom(value[0], item, key), numberFrom(value[1], item, key),
            numberFrom(value[2], item, key)};
}

std::string textFrom(const json& value, const JsonItem& item, const char* key)
{
    if (!value.is_string()) item.refuse(fmt::format("\"{}\" must be a text in \" \"", key), key);
    return value.get<std::string>();
}

const json& required(const JsonItem& item, const char* key)
{
    const json* value = item.find(key);
    if (value == nullptr) item.refuse(fmt::format("\"{}\" is missing", key));
    return *value;
}

/// What `take(value)` makes of every value of a list that may be there.
template<class Take>
auto listFrom(const JsonItem& item, const char* key, const Take& take)
{
    std::vector<decltype(take(item.object))> list;
    const json* values = item.find(key);
    if (values == nullptr) return list;
    if (!values->is_array()) item.refuse(fmt::format("\"{}\" must be a list", key), key);
    for (const json& value : *values) list.push_back(take(value));
    return list;
}

} // namespace

std::string printable(const json& value)
{
    return printableName(dumpJson(value), 40);
}

const json* JsonItem::find(const char* key) const
{
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

void JsonItem::refuse(const std::string& why, const std::string& key) const
{
    const int line = lines.at(key.empty() ? path : path + "/" + key);
    malformed(what, fmt::format("{} (line {})", why, line));
}

float JsonItem::numberAt(const char* key) const
{
    return numberFrom(required(*this, key), *this, key);
}

glm::vec3 JsonItem::vectorAt(const char* key) const
{
    return vectorFrom(required(*this, key), *this, key);
}

glm::vec3 JsonItem::lightAt(const char* key) const
{
    const glm::vec3 rgb = vectorAt(key);
    if (std::min({rgb.r, rgb.g, rgb.b}) < 0.0f)
        refuse(fmt::format("\"{}\" must not be negative", key), key);
    return rgb;
}

glm::vec2 JsonItem::pairAt(const char* key) const
{
    const json& value = required(*this, key);
    if (!value.is_array() || value.size() != 2)
        refuse(fmt::format("\"{}\": must be a list of two numbers", key), key);
    return {numberFrom(value[0], *this, key), numberFrom(value[1], *this, key)};
}

double JsonItem::numberAt(const char* key, double low, double high) const
{
    return numberFrom(required(*this, key), *this, key, low, high);
}

std::string JsonItem::textAt(const char* key) const
{
    return textFrom(required(*this, key), *this, key);
}

JsonItem JsonItem::objectAt(const char* key) const
{
    static_cast<void>(required(*this, key));
    return *objectIn(key);
}

glm::vec3 JsonItem::facing(const char* key) const
{
    const json* value = find(key);
    if (value == nullptr || *value == "omni") return glm::vec3(0.0f);
    const glm::vec3 normal = vectorFrom(*value, *this, key);
    const float length = glm::length(normal);
    return length > 0.0f ? normal / length : normal;
}

float JsonItem::size(const char* key, float otherwise) const
{
    if (!has(key)) return otherwise;
    const float size = numberAt(key);
    if (size < 0.0f) refuse(fmt::format("\"{}\" must not be negative", key), key);
    return size;
}

bool JsonItem::flag(const char* key, bool otherwise) const
{
    const json* value = find(key);
    if (value == nullptr) return otherwise;
    if (!value->is_boolean()) refuse(fmt::format("\"{}\" must be true or false", key), key);
    return value->get<bool>();
}

std::string JsonItem::text(const char* key, const std::string& otherwise) const
{
    return has(key) ? textAt(key) : otherwise;
}

std::int64_t JsonItem::whole(const char* key, std::int64_t low, std::int64_t high,
                             std::int64_t otherwise) const
{
    if (!has(key)) return otherwise;
    const json& value = *find(key);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= static_cast<double>(low) && number <= static_cast<double>(high)) ||
        number != std::floor(number))
        refuse(fmt::format("\"{}\" is {}; it must be a whole number between {} and {}", key,
                           printable(value), low, high),
               key);
    return value.get<std::int64_t>();
}

std::optional<JsonItem> JsonItem::objectIn(const char* key) const
{
    const json* value = find(key);
    if (value == nullptr) return {};
    if (!value->is_object()) refuse(fmt::format("\"{}\" must be an object in {{ }}", key), key);
    return JsonItem{*value, fmt::format("{}: {}", what, key), lines,
                    fmt::format("{}/{}", path, key)};
}

std::vector<glm::vec3> JsonItem::vectors(const char* key) const
{
    return listFrom(*this, key, [&](const json& value) { return vectorFrom(value, *this, key); });
}

std::vector<std::string> JsonItem::texts(const char* key) const
{
    return listFrom(*this, key, [&](const json& value) { return textFrom(value, *this, key); });
}

void JsonItem::warnOfUnknown(std::initializer_list<const char*> known,
                             std::vector<std::string>& warnings) const
{
    for (const auto& [key, value] : object.items()) {
        const auto isKey = [&, name = key](const char* k) { return name == k; };
        if (std::none_of(known.begin(), known.end(), isKey))
            warnings.push_back(fmt::format("{}: \"{}\" is not known and was passed over", what,
                                           printableName(key)));
    }
}

} // namespace relamp
