#include "lights/sun_item.h"

#include <glm/geometric.hpp>

namespace relamp
{

std::optional<Sun> sunOf(const JsonItem& top, std::vector<std::string>& warnings)
{
    if (!top.has("sun")) return {};
    const JsonItem item{*top.find("sun"), top.what + ": sun", top.lines, top.path + "/sun"};
    if (!item.object.is_object()) item.refuse("must be an object in { }");
    item.warnOfUnknown({"direction", "irradiance", "error", "determined"}, warnings);
    const glm::vec3 way = item.vectorAt("direction");
    const float length = glm::length(way);
    if (!(length > 0.0f)) item.refuse("\"direction\" must point somewhere", "direction");
    return Sun{.direction = way / length, .irradiance = item.lightAt("irradiance")};
}

} // namespace relamp
