#include "lights/json_item.h"

#include "base/fail.h"
#include "base/json.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr double kLargestNumber = 1e9; // of any unit; its square is still a float

float numberFrom(const json& value, const JsonItem& item, const char* key)
{
    if (!value.is_number()) item.refuse(fmt::format("\"{}\": must be a number", key), key);
    const auto number = value.get<double>();
    if (!(std::abs(number) <= kLargestNumber))
        item.refuse(fmt::format("\"{}\": must be a number between -1e9 and 1e9", key), key);
    return static_cast<float>(number);
}

glm::vec3 vectorFrom(const json& value, const JsonItem& item, const char* key)
{
    if (!value.is_array() || value.size() != 3)
        item.refuse(fmt::format("\"{}\": must be a list of three numbers", key), key);
    return {numberFrom(value[0], item, key), numberFrom(value[1], item, key),
            numberFrom(value[2], item, key)};
}

const json& required(const JsonItem& item, const char* key)
{
    const json* value = item.find(key);
    if (value == nullptr) item.refuse(fmt::format("\"{}\" is missing", key));
    return *value;
}

} // namespace

std::string printable(const json& value)
{
    return dumpJson(value).substr(0, 40);
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
    const json* value = find(key);
    if (value == nullptr) return otherwise;
    if (!value->is_string()) refuse(fmt::format("\"{}\" must be a text in \" \"", key), key);
    return value->get<std::string>();
}

void JsonItem::warnOfUnknown(std::initializer_list<const char*> known,
                             std::vector<std::string>& warnings) const
{
    for (const auto& [key, value] : object.items()) {
        const auto isKey = [&, name = key](const char* k) { return name == k; };
        if (std::none_of(known.begin(), known.end(), isKey))
            warnings.push_back(
                fmt::format("{}: \"{}\" is not known and was passed over", what, key));
    }
}

} // namespace relamp
