#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace relamp
{

/// Parses JSON of untrusted origin: bounded depth, an object at the top. Throws Error(malformed)
/// that begins with `name` and says the line.
nlohmann::json parseJson(std::string_view text, const std::string& name);

/// JSON as a file for people and programs. What is no UTF-8 in names of untrusted origin is
/// replaced.
std::string textOf(const nlohmann::ordered_json& document);

/// JSON on one line. The same of UTF-8.
std::string dumpJson(const nlohmann::json& document);

/// A float as the double that prints as short as the float does: 0.1f as 0.1.
double shortest(float value);

} // namespace relamp
