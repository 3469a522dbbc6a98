#pragma once

#include "lights/json_item.h"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace relamp
{

/// A lights file: JSON with its lines, its format checked.
class LightsDocument
{
public:
    static constexpr const char* kFormat = "relamp lights 1";

    /// Throws Error(cannotRead | malformed).
    explicit LightsDocument(const std::filesystem::path& file, const char* format = kFormat);

    [[nodiscard]] JsonItem top() const { return {document_, name_, lines_, ""}; }

private:
    LightsDocument(std::string name, const std::string& text, const char* format);

    std::string name_;
    nlohmann::json document_;
    JsonLines lines_;
};

} // namespace relamp
