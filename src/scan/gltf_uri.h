#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// "a%20b" as "a b".
std::string decodePercent(const std::string& uri);

bool isDataUri(const std::string& uri);

/// The bytes of a data URI in base64. Throws Error(malformed), beginning with `what`.
std::vector<uint8_t> decodeDataUri(const std::string& uri, const std::string& what);

/// What glTF calls a picture file of these bytes.
std::string mimeTypeOf(std::span<const uint8_t> bytes);

} // namespace relamp
