#include "scenes/lit_room.h"

#include "scenes/scenes.h"

#include <cmath>

namespace relamp::scenes
{
namespace
{

constexpr int kPixels = 96;

ShiningPanel ceilingPanel()
{
    const glm::vec3 alongX(0.8f, 0, 0);
    const glm::vec3 alongZ(0, 0, 0.6f);
    return {{LitRoom::kLampCentre - 0.5f * alongX - 0.5f * alongZ, alongX, alongZ},
            LitRoom::kLampRadiance};
}

} // namespace

glm::vec3 LitRoom::albedo(glm::vec3 place, glm::vec3 normal)
{
    const glm::vec3 off = glm::abs(place - kSheetCentre);
    if (normal.x > 0.5f && off.y < 0.4f && off.z < 0.5f) return glm::vec3(0.9f);
    if (normal.y < -0.5f) return glm::vec3(0.7f);
    if (normal.y < 0.5f) return {0.45f, 0.42f, 0.38f};
    const bool isDark = std::fmod(place.x + 10.0f, 1.0f) < 0.5f; // a striped floor
    return isDark ? glm::vec3(0.2f, 0.15f, 0.1f) : glm::vec3(0.5f, 0.4f, 0.3f);
}

LitRoom::LitRoom()
    : box(kSize, {ceilingPanel()}, albedo),
      scan(room(kSize, kPixels, [this](glm::vec3 p, glm::vec3 n) { return box.photo(p, n); }))
{}

DelitRoom litDelitRoom(const std::string& panel)
{
    const LitRoom lit;
    DelitRoom delit;
    delit.scan = copyOf(lit.scan);
    delit.albedo.push_back(room(LitRoom::kSize, kPixels, LitRoom::albedo).pages[0].image);
    delit.captured.fixtures.push_back({.centre = LitRoom::kLampCentre,
                                       .normal = {0, -1, 0},
                                       .area = LitRoom::kLampArea,
                                       .radiance = LitRoom::kLampRadiance,
                                       .id = kLitRoomPanel,
                                       .name = panel});
    return delit;
}

} // namespace relamp::scenes
