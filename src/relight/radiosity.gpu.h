#ifndef RELAMP_RADIOSITY_GPU_H
#define RELAMP_RADIOSITY_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

struct RadiosityStartArguments
{
    Uints firstMember; // of clusters, and one more
    Uints member;      // sides
    Floats weight;     // of sides
    Uints surfel;      // of sides
    Vec4s albedo;      // of surfels
    Vec4s direct;      // irradiance on sides
    Vec4s ofClusters;  // their albedo
    Vec4s irradiance;  // on clusters, by all bounces
    Uvec2s sent;       // by clusters, halves
    Floats sums;       // luminance of that, a workgroup each
    uint count;        // of clusters
};

struct RadiosityArguments
{
    Vec4s albedo;     // of clusters
    Vec4s arriving;   // on clusters
    Vec4s irradiance; // on clusters, by all bounces
    Uvec2s sent;      // by clusters, then by what lies beyond; halves
    Floats sums;
    float weight; // how often what arrives counts
    uint count;   // of clusters
    uint sending; // and of what lies beyond
};

struct RadiositySidesArguments
{
    Uints clusterOf;  // of sides
    Uints surfel;     // of sides
    Vec4s albedo;     // of surfels
    Vec4s direct;     // irradiance on sides that rays are to meet
    Vec4s irradiance; // by bounces, on clusters or on sides
    Vec4s known;      // irradiance on sides by what is known better; with that on sides
    Uvec2s sent;      // by sides, halves
    uint ofClusters;  // not 0: `irradiance` is on these
    uint count;       // of sides
};

SHARED_END

#ifndef __cplusplus

shared float partSums[gl_WorkGroupSize.x];

// Adds up a value of each thread of a workgroup, always in the same order; all of them call it.
void addUp(Floats sums, float value, uint count)
{
    const uint local = gl_LocalInvocationID.x;
    partSums[local] = value;
    for (uint step = gl_WorkGroupSize.x / 2; step > 0; step /= 2) {
        barrier();
        if (local < step) partSums[local] += partSums[local + step];
    }
    const uint group = threadIndex() / gl_WorkGroupSize.x;
    if (local == 0 && group * gl_WorkGroupSize.x < count) sums.at[group] = partSums[0];
}

#endif

#endif
