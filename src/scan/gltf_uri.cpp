#include "scan/gltf_uri.h"

#include "base/fail.h"

#include <cctype>
#include <cstring>

#include <tiny_gltf.h>

namespace relamp
{

std::string decodePercent(const std::string& uri)
{
    const auto digit = [](char c) {
        return c >= 'a' ? c - 'a' + 10 : c >= 'A' ? c - 'A' + 10 : c - '0';
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool escape = uri[i] == '%' && i + 2 < uri.size() &&
                            std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                            std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
        text += escape ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return text;
}

bool isDataUri(const std::string& uri)
{
    return uri.starts_with("data:");
}

std::vector<uint8_t> decodeDataUri(const std::string& uri, const std::string& what)
{
    const size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) malformed(what, "has a data URI that is not base64");
    // tinygltf knows a handful of media types; the bytes are the same under any.
    std::vector<uint8_t> bytes;
    std::string mimeType;
    if (!tinygltf::DecodeDataURI(&bytes, mimeType,
                                 "data:application/octet-stream;base64," + uri.substr(comma + 8), 0,
                                 false))
        malformed(what, "has a data URI that is empty or broken");
    return bytes;
}

std::string mimeTypeOf(std::span<const uint8_t> bytes)
{
    if (bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8) return "image/jpeg";
    if (bytes.size() > 12 && std::memcmp(bytes.data() + 8, "WEBP", 4) == 0) return "image/webp";
    if (bytes.size() > 12 && std::memcmp(bytes.data() + 1, "KTX 20", 6) == 0) return "image/ktx2";
    return "image/png";
}

} // namespace relamp
