#include "fuzz/gltf_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    fuzz::expectResultOrSentence("fuzz",
                                 [&] { fuzz::readAndWriteGltf(fuzz::bytesOf(data, size)); });
    return 0;
}
