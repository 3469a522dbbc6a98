#pragma once

#include "base/shared.h"

SHARED_BEGIN

// Light propagation volumes: Kaplanyan & Dachsbacher, "Cascaded Light Propagation Volumes for
// Real-Time Indirect Illumination", I3D 2010. Intensity over direction in two bands of spherical
// harmonics, Y = (c0, -c1 y, c1 z, -c1 x).

SHARED_CONST kPi = 3.14159265f;
SHARED_CONST kShC0 = 0.282094792f;   // 1 / (2 sqrt(pi))
SHARED_CONST kShC1 = 0.488602512f;   // sqrt(3 / (4 pi))
SHARED_CONST kLobeC0 = 0.886226925f; // sqrt(pi) / 2: the clamped cosine, projected
SHARED_CONST kLobeC1 = 1.02332671f;  // sqrt(pi / 3)

// Solid angles of the faces of a cell from the centre of its neighbour; one front and four side
// faces are 2 pi / 3, so that six neighbours see the whole sphere and constant light stays
// constant.
SHARED_CONST kFrontSolidAngle = 0.4006696846f;
SHARED_CONST kSideSolidAngle = 0.4234313544f;

// Basis values in direction w.
SHARED_FN vec4 shBasis(vec3 w)
{
    return vec4(kShC0, -kShC1 * w.y, kShC1 * w.z, -kShC1 * w.x);
}

// max(0, cos) around axis n.
SHARED_FN vec4 shLobe(vec3 n)
{
    return vec4(kLobeC0, -kLobeC1 * n.y, kLobeC1 * n.z, -kLobeC1 * n.x);
}

// Share of light in direction w that surfaces of total area / cell^2 = `coverage` hold up; they
// stop what comes towards their face.
SHARED_FN float blocked(vec4 coverage, vec3 w)
{
    return clamp(dot(coverage, shBasis(-w)), 0.0f, 1.0f);
}

// Irradiance on a surface of normal n from intensity `sh` in the centre of the cell that it faces:
// the light arrives over half a cell, perHalfCellSquared = 1 / (cell / 2)^2.
SHARED_FN float irradianceFromCell(vec4 sh, vec3 n, float perHalfCellSquared)
{
    return max(dot(sh, shLobe(-n)), 0.0f) * perHalfCellSquared;
}

SHARED_END
