#include "fuzz/targets.h"
#include "relight/ies.h"

#include <cmath>

void relamp::fuzz::readIesFile(Input input)
{
    expectResultOrSentence(input, [&] {
        const IesPhotometry lamp = parseIes(bytesOf(input), "fuzz.ies");
        for (const float horizontal : {0.0f, 1.0f, 4.0f, 6.28f})
            for (const float vertical : {0.0f, 0.7f, 1.6f, 3.14f}) {
                const float candela = lamp.profile->at(vertical, horizontal);
                if (!(candela >= 0.0f && std::isfinite(candela))) std::abort();
            }
        if (!(lamp.lumens > 0.0f && std::isfinite(lamp.lumens))) std::abort();
    });
}
