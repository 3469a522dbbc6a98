#include "lights/camera_item.h"
#include "lights/json_document.h"
#include "relamp/response.h"

#include <optional>

namespace relamp
{
namespace
{

/// What says "response", or that there is none: the camera of a lights file or of a file of its
/// own, or the model of a report's.
std::optional<JsonItem> cameraIn(const JsonItem& top)
{
    if (std::optional<JsonItem> camera = top.objectIn("camera")) return camera;
    const auto lights = top.has("lights") && top.find("lights")->is_object()
                            ? top.objectIn("lights")
                            : std::nullopt;
    const auto camera = lights ? lights->objectIn("camera") : std::nullopt;
    return camera ? camera->objectIn("model") : std::nullopt;
}

/// A file that a person wrote for its curve; in a lights file or a report a camera without one is
/// straight.
bool isCurveAlone(const JsonItem& top)
{
    return top.has("camera") && !top.has("format");
}

} // namespace

Response readResponse(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    const JsonDocument document(file, nullptr);
    const JsonItem top = document.top();
    const std::optional<JsonItem> camera = cameraIn(top);
    if (camera) {
        if (isCurveAlone(top) && !camera->has("response"))
            camera->refuse("lacks \"response\", the slopes of its curve from dark to bright; add "
                           "it, like [1, 1, 1.1, 1.2, 1.4], or say straight");
        return cameraOf(*camera, warnings).response;
    }
    if (top.text("format", "") == kLightsFormat) return {}; // of a camera that did nothing
    top.refuse(
        "tells no camera; name the lights.json or report.json of a scan by it, or a file "
        "like {\"camera\": {\"response\": [1, 1, 1.1, 1.2, 1.4]}}, slopes from dark to bright, "
        "or say straight");
}

} // namespace relamp
