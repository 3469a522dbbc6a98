#include "base/json.h"

#include "base/fail.h"
#include "relamp/printable.h"

#include <cstdlib>

namespace relamp
{
namespace
{

constexpr int kDeepest = 200; // what follows the text recursively must not run out of stack

/// Whether more brackets are open at once than anything real has.
///
/// The parser would tell a callback as well, but takes quadratic time where it has one.
bool isTooDeep(std::string_view text)
{
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size() && depth <= kDeepest; ++i) {
        const char c = text[i];
        if (c == '"') inString = !inString;
        if (inString && c == '\\') ++i;
        if (inString) continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
    }
    return depth > kDeepest;
}

} // namespace

nlohmann::json parseJson(std::string_view text, const std::string& name)
{
    using nlohmann::json;
    if (isTooDeep(text)) malformed(name, "its JSON is nested deeper than anything real");
    json document;
    try {
        document = json::parse(text);
    } catch (const json::exception& failure) {
        std::string why = failure.what();
        if (const size_t end = why.find("] "); end != std::string::npos) why.erase(0, end + 2);
        malformed(name, fmt::format("its JSON cannot be read: {}", printableName(why)));
    }
    if (!document.is_object()) malformed(name, "its JSON is not an object");
    return document;
}

std::string textOf(const nlohmann::ordered_json& document)
{
    return document.dump(1, '\t', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string dumpJson(const nlohmann::json& document)
{
    return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

double shortest(float value)
{
    return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

} // namespace relamp
