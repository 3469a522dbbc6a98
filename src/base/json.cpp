#include "base/json.h"

#include "base/fail.h"

#include <cstdlib>

namespace relamp
{
namespace
{

constexpr int kDeepest = 200; // what follows the text recursively must not run out of stack

} // namespace

nlohmann::json parseJson(std::string_view text, const std::string& name)
{
    using nlohmann::json;
    const auto refuseDepth = [&](int depth, json::parse_event_t, json&) {
        if (depth > kDeepest) malformed(name, "its JSON is nested deeper than anything real");
        return true;
    };
    json document;
    try {
        document = json::parse(text, refuseDepth);
    } catch (const json::exception& failure) {
        std::string why = failure.what();
        if (const size_t end = why.find("] "); end != std::string::npos) why.erase(0, end + 2);
        malformed(name, fmt::format("its JSON cannot be read: {}", why));
    }
    if (!document.is_object()) malformed(name, "its JSON is not an object");
    return document;
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
