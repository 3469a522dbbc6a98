#include "lights/sun_item.h"

#include <glm/geometric.hpp>

namespace relamp
{

std::optional<Sun> sunOf(const JsonItem& top, std::vector<std::string>& warnings)
{
    const std::optional<JsonItem> found = top.objectIn("sun");
    if (!found) return {};
    const JsonItem& item = *found;
    item.warnOfUnknown({"direction", "irradiance", "error", "determined"}, warnings);
    const glm::vec3 way = item.vectorAt("direction");
    const float length = glm::length(way);
    if (!(length > 0.0f)) item.refuse("\"direction\" must point somewhere", "direction");
    return Sun{.direction = way / length, .irradiance = item.lightAt("irradiance")};
}

} // namespace relamp
