#include "fuzz/fuzz.h"
#include "relamp/lights.h"

#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    const std::filesystem::path file = fuzz::fileWith(fuzz::textOf(data, size), "lights.json");
    fuzz::expectResultOrSentence(file, [&] {
        std::vector<std::string> warnings;
        lightsAsJson(readLights(file, warnings));
    });
    return 0;
}
