// The OBJ, and behind a NUL its material file.

#include "fuzz/expect_numbers.h"
#include "fuzz/targets.h"
#include "image/write_image.h"
#include "relamp/result.h"

#include <vector>

namespace relamp::fuzz
{
namespace
{

/// The scan of `input`, with what it names beside it.
std::filesystem::path scanOf(Input input)
{
    const std::string_view text = textOf(input);
    const size_t end = std::min(text.find('\0'), text.size());
    fileWith(text.substr(std::min(end + 1, text.size())), "fuzz.mtl");
    return fileWith(text.substr(0, end), "fuzz.obj");
}

/// A small picture for materials to name, grey with a white corner.
void putPicture()
{
    std::vector<uint8_t> pixels(3 * 16 * 16, 90);
    std::fill_n(pixels.begin(), 3 * 16, 255);
    const std::vector<uint8_t> png = encodePng(pixels, {16, 16}, 3);
    fileWith(textOf(png), "b.png");
}

} // namespace

void readObjFile(Input input)
{
    const std::filesystem::path obj = scanOf(input);
    expectResultOrSentence(input, [&] {
        Progress progress;
        readScan(obj, {}, progress);
    });
}

/// What relamp delight does, and what reads its result.
void delightObjFile(Input input)
{
    const std::filesystem::path obj = scanOf(input);
    putPicture();
    const std::filesystem::path result = folder() / "out";
    expectResultOrSentence(input, [&] {
        Progress progress;
        Scan scan = readScan(obj, {.longestSide = 64}, progress);
        const Decomposition found =
            delight(std::move(scan),
                    {.gather = {.quality = Quality::draft, .rays = 4, .shadowRays = 1},
                     .engine = {.engine = Engine::cpu}},
                    progress);
        writeResult(found, obj, result, progress);
        const DelitRoom room = readDelitRoom(result, {}, progress);
        for (const Image& page : room.albedo) expectNumbers(page);
        expectNumbers(room.captured);
        readScan(result / "fuzz.glb", {}, progress);
    });
    std::filesystem::remove_all(result);
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
        if (entry.path().filename().native().starts_with('.')) std::abort(); // half a result
}

} // namespace relamp::fuzz
