#include "fuzz/targets.h"
#include "relamp/lights.h"

#include <vector>

void relamp::fuzz::readLightsFile(Input input)
{
    const std::filesystem::path file = fileWith(textOf(input), "lights.json");
    expectResultOrSentence(input, [&] {
        std::vector<std::string> warnings;
        lightsAsJson(readLights(file, warnings));
    });
}
