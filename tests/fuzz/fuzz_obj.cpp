#include "fuzz/fuzz.h"
#include "relamp/scan.h"

/// The OBJ, and behind a NUL its material file.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace relamp;
    const std::string_view text = fuzz::textOf(data, size);
    const size_t end = std::min(text.find('\0'), text.size());
    const std::filesystem::path obj = fuzz::fileWith(text.substr(0, end), "fuzz.obj");
    fuzz::fileWith(text.substr(std::min(end + 1, text.size())), "fuzz.mtl");
    fuzz::expectResultOrSentence(obj.parent_path(), [&] {
        Progress progress;
        readScan(obj, {}, progress);
    });
    return 0;
}
