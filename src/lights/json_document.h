#pragma once

#include "lights/json_item.h"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace relamp
{

constexpr const char* kLightsFormat = "relamp lights 1";

/// A JSON file that a person may have written, with its lines, its format checked.
class JsonDocument
{
public:
    /// `format` is what the key "format" must say, if it is there; null where that is no matter.
    /// Throws Error(cannotRead | malformed).
    JsonDocument(const std::filesystem::path& file, const char* format);

    /// The same of a text; `name` is what it is called in errors. Throws Error(malformed).
    JsonDocument(std::string name, const std::string& text, const char* format);

    [[nodiscard]] JsonItem top() const { return {document_, name_, lines_, ""}; }

private:
    std::string name_;
    nlohmann::json document_;
    JsonLines lines_;
};

} // namespace relamp
