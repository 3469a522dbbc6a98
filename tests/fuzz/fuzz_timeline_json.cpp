#include "fuzz/targets.h"
#include "relamp/timeline.h"

#include <vector>

void relamp::fuzz::readTimelineFile(Input input)
{
    const std::filesystem::path file = fileWith(textOf(input), "day.json");
    const Lights room{.fixtures = {{.area = 0.5f, .radiance = glm::vec3(8.0f)}}};
    expectResultOrSentence(input, [&] {
        std::vector<std::string> warnings;
        const Timeline timeline(file, room, warnings);
        for (const double part : {0.0, 0.3, 1.0}) (void)timeline.at(part);
    });
}
