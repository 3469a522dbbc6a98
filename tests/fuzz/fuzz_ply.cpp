#include "fuzz/targets.h"
#include "scan/ply_read.h"

void relamp::fuzz::readPlyFile(Input input)
{
    expectResultOrSentence(input, [&] {
        Progress progress;
        readPly(bytesOf(input), "fuzz.ply", {}, progress);
    });
}
