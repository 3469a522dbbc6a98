#ifndef RELAMP_MESH_NOISE_SHARED_H
#define RELAMP_MESH_NOISE_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kMeshTilt = 0.04f; // rad, 2.3 degrees: what normals of a scan are off by
SHARED_CONST kMeshStep = 0.01f; // m, what its positions are

// By how many metres a place at `distance` may lie less before a patch than a scan says, and the
// patch before it. Only where both face alike, as a ceiling and a panel in it do, is that anything:
// these see one another by their tilt and by a step alone.
SHARED_FN float heightByMeshNoise(vec3 normal, vec3 patchNormal, float distance)
{
    const float alike = max(dot(normal, patchNormal), 0.0f);
    const float second = alike * alike;
    const float fourth = second * second;
    const float eighth = fourth * fourth;
    return eighth * eighth * (kMeshTilt * distance + kMeshStep);
}

// What is left, 0..1, of a patch's light on a place once the heights at which they see one another
// are less by what the noise of the mesh may have made of them. 1 where they face one another. This
// is no physics: it is for estimates from a scan's own mesh, as a factor on the exact form factor.
SHARED_FN float shareBeyondMeshNoise(vec3 toPatch, vec3 normal, vec3 patchNormal)
{
    const float received = dot(toPatch, normal);
    const float sent = -dot(toPatch, patchNormal);
    const float noise = heightByMeshNoise(normal, patchNormal, length(toPatch));
    return max(received - noise, 0.0f) * max(sent - noise, 0.0f) / max(received * sent, 1e-12f);
}

SHARED_END

#endif
