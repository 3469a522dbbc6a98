#include "relamp/lightmaps.h"

#include "base/fail.h"
#include "base/file.h"
#include "image/write_image.h"
#include "output/fixtures_file.h"
#include "output/lightmap_bytes.h"
#include "output/listed_folder.h"
#include "output/result_folder.h"
#include "relight/relighter_state.h"
#include "relight/relit_page.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relamp
{
namespace
{

using nlohmann::ordered_json;

constexpr const char* kLightmapList = "lightmaps.json";

const char* endingOf(LightmapFormat format)
{
    return format == LightmapFormat::png ? "png" : "exr";
}

/// "02_ceiling_lamp_2": sorts as the lights do, and is a name in every file system.
std::string stemOf(size_t place, const std::string& name)
{
    std::string stem = fmt::format("{:02}_", place);
    for (const char c : name.substr(0, 40))
        stem += std::isalnum(static_cast<unsigned char>(c)) != 0 && c >= 0 ? c : '_';
    return stem;
}

bool isLightmap(const std::string& name)
{
    const size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (name.starts_with("albedo.") || name.starts_with("fixtures.")) return true;
    return name == kLightmapList || (digits >= 2 && digits < name.size() && name[digits] == '_' &&
                                     (name.ends_with(".exr") || name.ends_with(".png")));
}

void writePng(const std::filesystem::path& file, std::span<const uint8_t> rgb, Size size)
{
    const std::vector<uint8_t> png = encodePng(rgb, size, 3);
    writeFile(file, std::as_bytes(std::span(png)));
}

/// Writes one picture; gives what lightmaps.json says of it.
ordered_json writeMap(const Image& map, const std::filesystem::path& file, LightmapFormat format)
{
    const Size size{map.width, map.height};
    ordered_json item{{"file", file.filename().string()}};
    if (format == LightmapFormat::exr) {
        writeExr(file, map.half(), size);
        return item;
    }
    const float scale = scaleOfLightmap(map.half());
    writePng(file, lightmapBytes(map.half(), scale), size);
    item["scale"] = scale;
    return item;
}

ordered_json vectorAsJson(glm::vec3 v)
{
    return {v.r, v.g, v.b};
}

/// The fixtures that shine under the light that was set.
ordered_json shiningAsJson(const Relighter& relighter)
{
    ordered_json list = ordered_json::array();
    for (const ActiveLight& light : relighter.state().active.lights)
        if (light.isFixture && light.fixture.id >= 0)
            list.push_back(
                {{"fixture", light.fixture.id}, {"radiance", vectorAsJson(light.emission)}});
    return list;
}

/// Writes what of a page is not light: its albedo, and whose its texels are. Gives what
/// lightmaps.json says of it.
ordered_json writePage(const Relighter& relighter, size_t p, const ListedFolder& folder,
                       LightmapFormat format)
{
    const DelitRoom& room = relighter.room();
    const size_t pages = room.scan->pages.size();
    const Image albedo = albedoPage(relighter.state(), p);
    const std::string name = nameOfLayer("albedo", p, pages, endingOf(format));
    if (format == LightmapFormat::exr)
        writeExr(folder / name, albedo.half(), {albedo.width, albedo.height});
    else
        writePng(folder / name, srgbBytes(albedo.half()), {albedo.width, albedo.height});
    ordered_json item{{"name", room.scan->pages[p].name}, {"albedo", name}};
    if (room.fixtures.empty()) return item;
    const FixtureMap& map = room.fixtures[p];
    item["fixtures"] = nameOfLayer("fixtures", p, pages, "png");
    writePng(folder / item["fixtures"], rgbOf(map), {map.width, map.height});
    return item;
}

FolderRules rulesOf(const LightmapOptions& options)
{
    return {kLightmapList, &isLightmap, options.replacing};
}

ordered_json writeMaps(Relighter& relighter, const LightPart& part, const std::string& stem,
                       const ListedFolder& folder, const LightmapOptions& options,
                       Progress& progress)
{
    const size_t pages = relighter.room().scan->pages.size();
    relighter.light(part.lighting, progress);
    ordered_json item{{"name", part.name}};
    if (part.fixture >= 0) item["fixture"] = part.fixture;
    item["shines"] = shiningAsJson(relighter);
    item["maps"] = ordered_json::array();
    for (size_t p = 0; p < pages; ++p) {
        const std::string name = nameOfLayer(stem.c_str(), p, pages, endingOf(options.format));
        item["maps"].push_back(writeMap(relighter.shading(p, options.longestSide, progress),
                                        folder / name, options.format));
    }
    return item;
}

} // namespace

void checkLightmaps(const std::filesystem::path& folder, const LightmapOptions& options)
{
    checkListedFolder(folder, rulesOf(options));
}

void writeLightmaps(Relighter& relighter, const Relighting& lighting,
                    const std::filesystem::path& folder, const LightmapOptions& options,
                    Progress& progress)
{
    std::error_code ignored;
    if (std::filesystem::equivalent(folder, relighter.room().folder, ignored))
        fail(ErrorCode::cannotWrite, folder.string(),
             "is the room's own folder, whose albedo and fixtures lightmaps would replace by files "
             "of the same names; name another folder");
    const std::vector<LightPart> parts = partsOf(lighting, relighter);
    if (parts.empty())
        fail(ErrorCode::unsupported, folder.string(),
             "no light is on, so there is nothing to make lightmaps of; turn fixtures on, or bring "
             "lights");
    ListedFolder files(folder, rulesOf(options), progress);
    Progress::Stage stage(progress, "lightmaps", parts.size());
    ordered_json lights = ordered_json::array();
    for (size_t i = 0; i < parts.size(); ++i) {
        progress.setPart(fmt::format("lightmap {} of {}", i + 1, parts.size()));
        lights.push_back(
            writeMaps(relighter, parts[i], stemOf(i, parts[i].name), files, options, progress));
        stage.advance();
    }
    progress.setPart({});
    ordered_json pages = ordered_json::array();
    for (size_t p = 0; p < relighter.room().scan->pages.size(); ++p)
        pages.push_back(writePage(relighter, p, files, options.format));
    files.commit({{"format", "relamp lightmaps 1"},
                  {"encoding", options.format == LightmapFormat::exr
                                   ? "irradiance / pi"
                                   : "irradiance / pi = scale * (byte / 255)^4"},
                  {"pages", std::move(pages)},
                  {"lights", std::move(lights)}});
}

} // namespace relamp
