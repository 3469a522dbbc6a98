// A scan and its result's folder, of which some files are damaged or gone.

#include "base/hash.h"
#include "fuzz/expect_numbers.h"
#include "fuzz/result_files.h"
#include "fuzz/targets.h"
#include "relamp/light_probes.h"
#include "relamp/picture.h"
#include "relamp/verify.h"

#include <vector>

namespace relamp::fuzz
{
namespace
{

constexpr uint8_t kTransport = 2; // of kFilesOfResult

/// Its checksum stands behind eight bytes of version and eight of the room's key, and without it no
/// change would get further.
void mendChecksum(std::string& transport)
{
    constexpr size_t kChecksum = 16;
    constexpr size_t kContent = kChecksum + sizeof(uint64_t);
    if (transport.size() < kContent) return;
    Hash hash;
    hash.addBytes(std::as_bytes(std::span(transport).subspan(kContent)));
    const uint64_t value = hash.value();
    std::memcpy(&transport[kChecksum], &value, sizeof value);
}

void mutateFile(std::string& content, size_t most)
{
    std::vector<uint8_t> bytes(content.begin(), content.end());
    bytes.resize(std::max<size_t>(content.size(), most));
    bytes.resize(LLVMFuzzerMutate(bytes.data(), content.size(), bytes.size()));
    content.assign(bytes.begin(), bytes.end());
}

/// What relamp relight and the viewer do with it.
void relightResult(const std::filesystem::path& result)
{
    Progress progress;
    const DelitRoom room = readDelitRoom(result, {}, progress);
    expectNumbers(room.captured);
    Relighting lighting = darkened(room.captured);
    if (!lighting.fixtures.empty()) setFixture(lighting, room.captured, "all=on");
    Relighter relighter(room,
                        {.rays = 4,
                         .shadowRays = 1,
                         .transport = room.transport,
                         .engine = {.engine = Engine::cpu}},
                        progress);
    relighter.glance(lighting, progress);
    const LightProbes probes(relighter, std::vector{SurfacePlace{glm::vec3(0.0f), {0, 1, 0}}});
    for (const LightAtPlace& light : probes.light(relighter))
        expectNumber(light.shading + light.emission);
    relighter.light(lighting, progress);
    for (const Image& page : radianceOfPages(relighter, progress)) expectNumbers(page);
}

/// What relamp verify does.
void verifyResult(const std::filesystem::path& result)
{
    Progress progress;
    const Verification figures = verify(result, {.samples = 2, .places = 16}, progress);
    expectNumber({figures.rmsError, figures.psnr, figures.standardError});
    expectNumber(figures.ratio);
}

/// What relamp relight --lights and the viewer do with its lights.
void readLightsAgain(const std::filesystem::path& result)
{
    std::vector<std::string> warnings;
    const Lights room{.fixtures = {{.area = 0.5f, .radiance = glm::vec3(8.0f)}}};
    (void)readRelighting(result / "lights.json", room, warnings);
}

} // namespace

size_t mutateResult(uint8_t* data, size_t size, size_t most, unsigned seed)
{
    ResultFiles files = split(textOf({data, size}));
    if (files.empty()) return LLVMFuzzerMutate(data, size, most);
    const size_t favourites = seed % 8 < 6 ? std::min<size_t>(3, files.size()) : files.size();
    const auto file = std::next(files.begin(), static_cast<ptrdiff_t>(seed / 8 % favourites));
    mutateFile(file->second, std::min<size_t>(most, 2 * file->second.size() + 64));
    if (file->first == kTransport && seed / 64 % 8 != 0) mendChecksum(file->second);
    if (seed / 512 % 64 == 0) files.erase(file);
    const std::string bytes = joined(files);
    if (bytes.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::memcpy(data, bytes.data(), bytes.size());
    return bytes.size();
}

void useResult(Input input)
{
    std::filesystem::remove_all(folder() / "out");
    std::filesystem::create_directory(folder() / "out");
    for (const auto& [index, content] : split(textOf(input)))
        fileWith(content, kFilesOfResult[index]);
    for (const auto use : {relightResult, verifyResult, readLightsAgain})
        expectResultOrSentence(input, [&] { use(folder() / "out"); });
}

} // namespace relamp::fuzz
