#include "shading/tempering.h"

#include "base/radiometry.shared.h"
#include "shading/tempering.shared.h"

namespace relamp
{

void temper(const Tempering& tempering, size_t count, ShadingBlock& shading)
{
    if (tempering.power == 1.0f) return;
    RgbBlock& direct = shading.direct;
    RgbBlock& indirect = shading.indirect;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 total(direct.r[i] + indirect.r[i], direct.g[i] + indirect.g[i],
                              direct.b[i] + indirect.b[i]);
        const glm::vec3 times = temperedBy(total, tempering.kept, tempering.power);
        for (RgbBlock* part : {&direct, &indirect}) {
            part->r[i] *= times.r;
            part->g[i] *= times.g;
            part->b[i] *= times.b;
        }
    }
}

std::vector<glm::vec3> tempered(const Tempering& tempering, std::vector<glm::vec3> irradiance)
{
    for (glm::vec3& e : irradiance) e *= temperedBy(e / kPi, tempering.kept, tempering.power);
    return irradiance;
}

} // namespace relamp
