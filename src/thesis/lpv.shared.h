#ifndef RELAMP_LPV_SHARED_H
#define RELAMP_LPV_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

// Light propagation volumes: Kaplanyan & Dachsbacher, "Cascaded Light Propagation Volumes for
// Real-Time Indirect Illumination", I3D 2010. Intensity over direction in two bands of spherical
// harmonics, Y = (c0, -c1 y, c1 z, -c1 x).

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

// What a cell sends in direction w; a face that is covered lets 1 - blocked() of it through.
SHARED_FN float sentTowards(vec4 sh, vec3 w)
{
    return max(dot(sh, shBasis(w)), 0.0f);
}

// Light comes into a cell from six sources, its neighbours, travelling along an axis; 0..5 travel
// towards +x -x +y -y +z -z.
SHARED_FN vec3 travelFrom(int source)
{
    vec3 travel = vec3(0.0f);
    travel[source / 2] = source % 2 == 0 ? 1.0f : -1.0f;
    return travel;
}

// It enters through five faces: 0 is straight ahead, 1..4 at the sides. A face's normal is where
// light leaves the cell through it, and where it is sent on to.
SHARED_FN vec3 faceNormal(int source, int face)
{
    if (face == 0) return travelFrom(source);
    const int side = (face - 1) / 2;
    vec3 normal = vec3(0.0f);
    normal[side < source / 2 ? side : side + 1] = face % 2 == 1 ? 1.0f : -1.0f;
    return normal;
}

// From the centre of the source to the centre of the face: the face straight ahead is 1.5 cells
// off; the four at the sides are one ahead, half aside.
SHARED_FN vec3 faceDirection(int source, int face)
{
    const vec3 travel = travelFrom(source);
    return face == 0 ? travel : normalize(travel + 0.5f * faceNormal(source, face));
}

SHARED_FN float faceSolidAngle(int face)
{
    return face == 0 ? kFrontSolidAngle : kSideSolidAngle;
}

// The cell that holds a place, kept off the border.
SHARED_FN ivec3 cellHolding(vec3 world, vec3 origin, float cell, ivec3 cells)
{
    return ivec3(clamp(floor((world - origin) / cell), vec3(1.0f), vec3(cells - 2)));
}

// Where a surface looks up its light, in cells from the centre of the first: half a cell off.
SHARED_FN vec3 lookUpPlace(vec3 position, vec3 normal, vec3 origin, float cell, ivec3 cells)
{
    const float perCell = 1.0f / cell;
    const vec3 shift = -origin * perCell - 0.5f;
    return clamp(position * perCell + 0.5f * normal + shift, vec3(0.0f), vec3(cells) - 1.001f);
}

SHARED_END

#endif
