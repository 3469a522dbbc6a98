#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace relamp
{

/// Checks that whatever relamp reads or writes of a glTF 2 document is of the type, length and
/// range that glTF gives it, so that nothing later meets a text where a number belongs. Whole
/// numbers that are written as 4.0 become whole. Where a number leads is not looked at.
///
/// Throws Error(malformed) that names `file`, the part and what belongs there.
void checkShape(nlohmann::json& document, const std::string& file);

} // namespace relamp
