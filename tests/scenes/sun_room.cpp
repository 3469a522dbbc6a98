#include "scenes/sun_room.h"
#include "base/radiometry.shared.h"

namespace relamp::scenes
{
namespace
{

constexpr int kSunPixels = 128;
constexpr float kLow = 1.0f; // of the window
constexpr float kHigh = 2.2f;
constexpr float kLeft = 2.2f;
constexpr float kWidth = 1.2f;

Panel panelOverhead()
{
    return {{0.9f, SunRoom::kSize.y, 2.2f}, {0.8f, 0, 0}, {0, 0, 0.6f}};
}

/// Where the sun throws a point of the window.
glm::vec3 onFloor(float y, float z, glm::vec3 towardsSun)
{
    return glm::vec3(SunRoom::kSize.x, y, z) - y / towardsSun.y * towardsSun;
}

std::vector<ShiningPanel> lampsOf(glm::vec3 patch, float pane, glm::vec3 towardsSun)
{
    std::vector<ShiningPanel> lamps{{panelOverhead(), {16.0f, 15.0f, 14.0f}}};
    if (patch.g > 0.0f) lamps.push_back({SunRoom::patchPanel(towardsSun), patch});
    if (pane > 0.0f) lamps.push_back({SunRoom::window(), glm::vec3(pane)});
    return lamps;
}

std::vector<Panel> panelsOf(bool hasPane)
{
    std::vector<Panel> panels = wallsOf(SunRoom::kSize);
    const float x = SunRoom::kSize.x;
    const glm::vec3 length(0, 0, SunRoom::kSize.z);
    const glm::vec3 height(0, kHigh - kLow, 0);
    panels.erase(panels.begin() + 3);
    panels.push_back({{x, 0, 0}, length, {0, kLow, 0}});
    panels.push_back({{x, kHigh, 0}, length, {0, SunRoom::kSize.y - kHigh, 0}});
    panels.push_back({{x, kLow, 0}, {0, 0, kLeft}, height});
    panels.push_back(
        {{x, kLow, kLeft + kWidth}, {0, 0, SunRoom::kSize.z - kLeft - kWidth}, height});
    if (hasPane) panels.push_back(SunRoom::window());
    return panels;
}

} // namespace

Panel SunRoom::window()
{
    return {{kSize.x, kLow, kLeft}, {0, 0, kWidth}, {0, kHigh - kLow, 0}};
}

Panel SunRoom::patchPanel(glm::vec3 towardsSun)
{
    const glm::vec3 far = onFloor(kHigh, kLeft, towardsSun);
    return {far, {0, 0, kWidth}, onFloor(kLow, kLeft, towardsSun) - far};
}

glm::vec3 SunRoom::albedo(glm::vec3 place, glm::vec3 normal)
{
    if (normal.x < -0.5f && place.y > kLow && place.y < kHigh && place.z > kLeft &&
        place.z < kLeft + kWidth)
        return glm::vec3(0.0f); // nothing comes back from the window
    if (normal.y > 0.5f) return kFloor;
    return normal.y < -0.5f ? glm::vec3(0.7f) : glm::vec3(0.55f, 0.52f, 0.5f);
}

Scan SunRoom::scanOf(const Paint& photo)
{
    return panels(panelsOf(false), kSunPixels, photo);
}

SunRoom::SunRoom(glm::vec3 sun, float paneRadiance, glm::vec3 towardsSun, const Paint& paint)
    : box(kSize, lampsOf(kFloor * sun / kPi, paneRadiance, towardsSun), paint),
      scan(panels(panelsOf(paneRadiance > 0.0f), kSunPixels,
                  [this](glm::vec3 p, glm::vec3 n) { return box.photo(p, n); }))
{}

} // namespace relamp::scenes
