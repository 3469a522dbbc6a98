#include "output/camera_file.h"

#include "lights/json_document.h"
#include "relamp/names.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relamp
{
namespace
{

constexpr const char* kFormat = "relamp camera 1";
constexpr float kSmallestAngle = 1.0f; // degrees
constexpr float kLargestAngle = 170.0f;

/// Where it looks: at a place, or along a direction.
glm::vec3 forwardFrom(const JsonItem& item, glm::vec3 position)
{
    if (item.has("target") == item.has("forward"))
        item.refuse(
            "needs either \"target\", a place that it looks at, or \"forward\", a direction");
    const char* key = item.has("target") ? "target" : "forward";
    const glm::vec3 forward =
        item.has("target") ? item.vectorAt(key) - position : item.vectorAt(key);
    const float length = glm::length(forward);
    if (!(length > 1e-6f))
        item.refuse(item.has("target") ? "\"target\" is where the camera is; it must be elsewhere"
                                       : "\"forward\" has no length",
                    key);
    return forward / length;
}

/// Upwards in the picture; where a camera looks straight up or down, whatever is level.
glm::vec3 upFrom(const JsonItem& item, glm::vec3 forward)
{
    constexpr float kAlong = 1e-3f; // sine of the angle between the two
    if (item.has("up")) {
        const glm::vec3 up = item.facing("up");
        if (!(glm::length(glm::cross(forward, up)) > kAlong))
            item.refuse("\"up\" is none: it must have a length, and not be along the view", "up");
        return up;
    }
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    return glm::length(glm::cross(forward, up)) > kAlong ? up : glm::vec3(0.0f, 0.0f, -1.0f);
}

Across acrossFrom(const JsonItem& item)
{
    const auto across = named<Across>(item.text("across", nameOf(Across::width)));
    if (!across) item.refuse("\"across\" must be \"width\" or \"height\"", "across");
    return *across;
}

} // namespace

Camera readCamera(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    const JsonDocument document(file, kFormat);
    const JsonItem top = document.top();
    top.warnOfUnknown({"format", "position", "target", "forward", "up", "fieldOfView", "across"},
                      warnings);
    Camera camera;
    camera.position = top.vectorAt("position");
    camera.forward = forwardFrom(top, camera.position);
    camera.up = upFrom(top, camera.forward);
    camera.across = acrossFrom(top);
    if (top.has("fieldOfView")) {
        const float degrees = top.numberAt("fieldOfView");
        if (!(degrees >= kSmallestAngle && degrees <= kLargestAngle))
            top.refuse(fmt::format("\"fieldOfView\" is {}; it must be {} to {} degrees", degrees,
                                   kSmallestAngle, kLargestAngle),
                       "fieldOfView");
        camera.fieldOfView = glm::radians(degrees);
    }
    return camera;
}

} // namespace relamp
