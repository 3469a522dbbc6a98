#ifndef RELAMP_THESIS_SHADING_SHARED_H
#define RELAMP_THESIS_SHADING_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

// Irradiance of lights to shading, S = E / pi, under the parameters power and ambient.
SHARED_FN vec3 shadingFrom(vec3 irradiance, float power, vec3 ambient)
{
    return power / kPi * irradiance + ambient;
}

SHARED_END

#endif
