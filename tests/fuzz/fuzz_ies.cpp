#include "fuzz/fuzz.h"
#include "relight/ies.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    fuzz::expectResultOrSentence("lamp.ies", [&] {
        const IesPhotometry lamp = parseIes(fuzz::bytesOf(data, size), "lamp.ies");
        for (const float horizontal : {0.0f, 1.0f, 4.0f, 6.28f})
            for (const float vertical : {0.0f, 0.7f, 1.6f, 3.14f}) {
                const float candela = lamp.profile->at(vertical, horizontal);
                if (!(candela >= 0.0f && std::isfinite(candela))) std::abort();
            }
        if (!(lamp.lumens > 0.0f && std::isfinite(lamp.lumens))) std::abort();
    });
    return 0;
}
