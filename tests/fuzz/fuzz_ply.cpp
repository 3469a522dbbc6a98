#include "fuzz/fuzz.h"
#include "scan/ply_read.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    fuzz::expectResultOrSentence("fuzz.ply", [&] {
        Progress progress;
        readPly(fuzz::bytesOf(data, size), "fuzz.ply", {}, progress);
    });
    return 0;
}
