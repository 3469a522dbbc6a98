#pragma once

#include "fuzz/fuzz.h"

namespace relamp::fuzz
{

/// What made-up input is given to: a reader, or more of relamp.
using Target = void (*)(Input input);

void readGltfFile(Input input);
void readObjFile(Input input);
void delightObjFile(Input input);
void readPlyFile(Input input);
void readPicture(Input input);
void readLightsFile(Input input);
void readTimelineFile(Input input);
void readIesFile(Input input);
void useResult(Input input);

/// Changes the first `size` bytes of `data`, which has room for `most`, and returns how many they
/// are now: as LLVMFuzzerMutate does, but so that what a change would break besides stays right.
using Mutator = size_t (*)(uint8_t* data, size_t size, size_t most, unsigned seed);

size_t mutateGltf(uint8_t* data, size_t size, size_t most, unsigned seed);
size_t mutatePicture(uint8_t* data, size_t size, size_t most, unsigned seed);
size_t mutateResult(uint8_t* data, size_t size, size_t most, unsigned seed);

} // namespace relamp::fuzz
