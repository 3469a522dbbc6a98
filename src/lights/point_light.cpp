#include "lights/point_light.h"

#include "base/radiometry.shared.h"

#include <cmath>

namespace relamp
{

glm::vec3 intensityOf(const Fixture& fixture)
{
    return 0.25f * fixture.area * fixture.radiance;
}

PointLight pointLightOf(const Fixture& fixture, int index)
{
    PointLight light;
    light.position = fixture.centre;
    light.normal = fixture.normal;
    light.intensity = intensityOf(fixture);
    light.radius = std::sqrt(fixture.area / kPi);
    light.fixture = index;
    return light;
}

} // namespace relamp
