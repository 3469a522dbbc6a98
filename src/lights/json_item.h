#pragma once

#include "base/json_lines.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace relamp
{

/// An object of a file that a person may have written: what to call it in a sentence, and where it
/// stands. What is not as it must be throws Error(malformed) naming the file, the object, the key
/// and the line.
struct JsonItem
{
    const nlohmann::json& object;
    std::string what; // "lights.json: light 1"
    const JsonLines& lines;
    std::string path; // "/lights/1"

    [[nodiscard]] const nlohmann::json* find(const char* key) const;
    [[nodiscard]] bool has(const char* key) const { return find(key) != nullptr; }

    /// Throws with the line of `key`, or of the object itself.
    [[noreturn]] void refuse(const std::string& why, const std::string& key = {}) const;

    // A value that must be there:
    [[nodiscard]] float numberAt(const char* key) const;     // -1e9..1e9
    [[nodiscard]] glm::vec3 vectorAt(const char* key) const; // three of these
    [[nodiscard]] glm::vec3 lightAt(const char* key) const;  // none of them negative
    [[nodiscard]] glm::vec2 pairAt(const char* key) const;   // two of these
    [[nodiscard]] double numberAt(const char* key, double low, double high) const;
    [[nodiscard]] std::string textAt(const char* key) const;
    [[nodiscard]] JsonItem objectAt(const char* key) const;
    // A value that may be there:
    [[nodiscard]] glm::vec3 facing(const char* key) const; // unit; zero for "omni" or none
    [[nodiscard]] float size(const char* key, float otherwise = 0.0f) const; // not negative
    [[nodiscard]] bool flag(const char* key, bool otherwise) const;
    [[nodiscard]] std::string text(const char* key, const std::string& otherwise) const;
    [[nodiscard]] std::int64_t whole(const char* key, std::int64_t low, std::int64_t high,
                                     std::int64_t otherwise) const;
    [[nodiscard]] std::optional<JsonItem> objectIn(const char* key) const;
    [[nodiscard]] std::vector<glm::vec3> vectors(const char* key) const; // as of vectorAt
    [[nodiscard]] std::vector<std::string> texts(const char* key) const;

    /// Adds a sentence for every key but these.
    void warnOfUnknown(std::initializer_list<const char*> known,
                       std::vector<std::string>& warnings) const;

    /// Calls `take(item)` for every object of a list that may be there; `one` is what to call one.
    template<class Take>
    void forEachIn(const char* key, const std::string& one, const Take& take) const;
};

/// A value as it stands in a sentence.
std::string printable(const nlohmann::json& value);

template<class Take>
void JsonItem::forEachIn(const char* key, const std::string& one, const Take& take) const
{
    if (!has(key)) return;
    const nlohmann::json& list = *find(key);
    if (!list.is_array()) refuse(fmt::format("\"{}\" must be a list", key), key);
    for (size_t i = 0; i < list.size(); ++i) {
        const JsonItem item{list[i], fmt::format("{}: {} {}", what, one, i), lines,
                            fmt::format("{}/{}/{}", path, key, i)};
        if (!item.object.is_object()) item.refuse("must be an object in { }");
        take(item);
    }
}

} // namespace relamp
