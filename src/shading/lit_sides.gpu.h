#ifndef RELAMP_LIT_SIDES_GPU_H
#define RELAMP_LIT_SIDES_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

// Traits of a surfel, as bits.
const uint kKnowsItsAlbedo = 1u; // not burnt out nearly all over
const uint kShines = 2u;         // its burnt-out texels are a lamp's

struct LitSidesArguments
{
    Vec4s gathered;  // of lists
    Uvec2s direct;   // of lists, halves
    Ints backOf;     // of surfels: list of its back, -1 where nobody sees that
    Uvec2s burntOut; // of surfels, halves: what the texture shows of it
    Uvec2s white;    // of surfels, halves: what white of the texture stands for
    Uints traits;
    Uints firstNeighbor;
    Uints neighbor;
    Uvec2s plain;       // of surfels, halves
    Uvec2s field;       // as fieldOnGpu(); what follows `plain` is written
    float mostBurntOut; // radiance of what is
    uint count;         // of surfels
};

struct ExcessArguments
{
    Vec4s gathered; // of lists
    Vec4s even;
    Vec4s excess; // of surfels
    uint count;
};

struct LitSidesMeanArguments
{
    Vec4s values; // of surfels
    Uints firstNeighbor;
    Uints neighbor;
    Vec4s means;
    uint count;
};

struct IndirectArguments
{
    Vec4s even;   // gathered, of lists; w: noise
    Vec4s excess; // of surfels
    Uints firstNeighbor;
    Uints neighbor;
    Floats lit;       // of surfels: w of what is written
    Vec4s irradiance; // of surfels
    uint count;
};

SHARED_END

#endif
