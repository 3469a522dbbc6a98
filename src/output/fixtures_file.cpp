#include "output/fixtures_file.h"

#include "base/fail.h"
#include "output/result_folder.h"
#include "relamp/result.h"

namespace relamp
{
namespace
{

constexpr uint32_t kCodeOfNone = 0x000000;
constexpr uint32_t kCodeOfWall = 0xffffff;
static_assert(kLargestFixtureId + 1 < static_cast<int>(kCodeOfWall));

uint32_t codeOf(int32_t fixture)
{
    if (fixture == FixtureMap::kNone) return kCodeOfNone;
    return fixture == FixtureMap::kWall ? kCodeOfWall : static_cast<uint32_t>(fixture) + 1;
}

int32_t fixtureFrom(uint32_t code)
{
    if (code == kCodeOfNone) return FixtureMap::kNone;
    return code == kCodeOfWall ? FixtureMap::kWall : static_cast<int32_t>(code) - 1;
}

/// Whether a lights file lies in the folder of a result of this scan file.
bool isOfResultOf(const std::filesystem::path& folder, const std::filesystem::path& scanFile)
{
    try {
        return readFormerRun(folder).scanMark == markOf(scanFile);
    } catch (const Error&) {
        return false;
    }
}

} // namespace

std::vector<uint8_t> rgbOf(const FixtureMap& map)
{
    std::vector<uint8_t> rgb(3 * map.id.size());
    for (size_t i = 0; i < map.id.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            rgb[3 * i + c] = static_cast<uint8_t>(codeOf(map.id[i]) >> (8 * c));
    return rgb;
}

FixtureMap fixtureMapFrom(const Image& picture, const std::string& name)
{
    if (!picture.isEncoded())
        malformed(name, "must be a picture of 8 bits, as relamp wrote it; let relamp delight write "
                        "the folder anew, with --force");
    FixtureMap map{picture.width, picture.height, {}};
    map.id.resize(picture.pixels());
    for (size_t i = 0; i < map.id.size(); ++i) {
        const uint8_t* rgb = &picture.encoded()[3 * i];
        map.id[i] = fixtureFrom(rgb[0] | uint32_t{rgb[1]} << 8 | uint32_t{rgb[2]} << 16);
    }
    return map;
}

std::vector<FixtureMap> readFixtureMaps(const std::filesystem::path& folder, size_t pages)
{
    std::vector<FixtureMap> maps;
    for (size_t p = 0; p < pages; ++p) {
        const auto file = folder / nameOfLayer("fixtures", p, pages, "png");
        maps.push_back(fixtureMapFrom(readImage(file), file.string()));
    }
    return maps;
}

std::vector<FixtureMap> readFixturesBeside(const std::filesystem::path& lights,
                                           const std::filesystem::path& scanFile, const Scan& scan)
{
    const auto folder =
        lights.has_parent_path() ? lights.parent_path() : std::filesystem::path(".");
    const size_t pages = scan.pages.size();
    std::error_code ignored;
    if (!std::filesystem::exists(folder / nameOfLayer("fixtures", 0, pages, "png"), ignored) ||
        !isOfResultOf(folder, scanFile))
        return {};
    return readFixtureMaps(folder, pages);
}

} // namespace relamp
