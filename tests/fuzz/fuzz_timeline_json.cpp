#include "fuzz/fuzz.h"
#include "relamp/timeline.h"

#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    const std::filesystem::path file = fuzz::fileWith(fuzz::textOf(data, size), "day.json");
    const Lights room{.fixtures = {{.area = 0.5f, .radiance = glm::vec3(8.0f)}}};
    // Files that it names are beside it, and so is what a sentence about them names.
    fuzz::expectResultOrSentence(file.parent_path(), [&] {
        std::vector<std::string> warnings;
        const Timeline timeline(file, room, warnings);
        for (const double part : {0.0, 0.3, 1.0}) (void)timeline.at(part);
    });
    return 0;
}
