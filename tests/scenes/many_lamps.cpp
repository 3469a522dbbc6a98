#include "scenes/many_lamps.h"

#include <cmath>

namespace relamp::scenes
{
namespace
{

constexpr int kPanelPixels = 200;

std::vector<ShiningPanel> grid(int alongX, int alongZ, glm::vec3 radiance)
{
    const glm::vec3 size = ManyLamps::kSize;
    const glm::vec3 u(ManyLamps::kLampSize.x, 0, 0);
    const glm::vec3 v(0, 0, ManyLamps::kLampSize.y);
    std::vector<ShiningPanel> lamps;
    for (int z = 0; z < alongZ; ++z)
        for (int x = 0; x < alongX; ++x) {
            const glm::vec3 centre(
                size.x * (static_cast<float>(x) + 0.5f) / static_cast<float>(alongX), size.y,
                size.z * (static_cast<float>(z) + 0.5f) / static_cast<float>(alongZ));
            lamps.push_back({{centre - 0.5f * u - 0.5f * v, u, v}, radiance});
        }
    return lamps;
}

glm::vec3 albedo(glm::vec3 place, glm::vec3 normal)
{
    if (normal.y < -0.5f) return glm::vec3(0.7f);
    if (normal.y < 0.5f) return {0.45f, 0.42f, 0.38f};
    const bool isDark = std::fmod(place.x, 2.0f) < 1.0f; // a striped floor
    return isDark ? glm::vec3(0.2f, 0.15f, 0.1f) : glm::vec3(0.5f, 0.4f, 0.3f);
}

} // namespace

ManyLamps::ManyLamps(int alongX, int alongZ)
    : lampRadiance(kRadianceOf300 * 300.0f / static_cast<float>(alongX * alongZ)),
      box(kSize, grid(alongX, alongZ, lampRadiance), albedo),
      scan(room(kSize, kPanelPixels, [this](glm::vec3 p, glm::vec3 n) { return box.photo(p, n); }))
{}

} // namespace relamp::scenes
