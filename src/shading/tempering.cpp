#include "shading/tempering.h"

#include "base/radiometry.shared.h"
#include "shading/tempering.shared.h"

#include <glm/exponential.hpp>

namespace relamp
{

glm::vec3 factorOf(const Tempering& tempering)
{
    return tempering.scale * glm::pow(tempering.kept, glm::vec3(1.0f - tempering.power));
}

void temper(const Tempering& tempering, size_t count, ShadingBlock& shading)
{
    const glm::vec3 factor = factorOf(tempering);
    if (tempering.power == 1.0f && factor == glm::vec3(1.0f)) return;
    RgbBlock& direct = shading.direct;
    RgbBlock& indirect = shading.indirect;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 total(direct.r[i] + indirect.r[i], direct.g[i] + indirect.g[i],
                              direct.b[i] + indirect.b[i]);
        const glm::vec3 times = temperedBy(total, factor, tempering.power);
        for (RgbBlock* part : {&direct, &indirect}) {
            part->r[i] *= times.r;
            part->g[i] *= times.g;
            part->b[i] *= times.b;
        }
    }
}

std::vector<glm::vec3> tempered(const Tempering& tempering, std::vector<glm::vec3> irradiance)
{
    const glm::vec3 factor = factorOf(tempering);
    for (glm::vec3& e : irradiance) e *= temperedBy(e / kPi, factor, tempering.power);
    return irradiance;
}

} // namespace relamp
