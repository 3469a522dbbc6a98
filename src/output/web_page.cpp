#include "relamp/page.h"

#include "base/fail.h"
#include "base/file.h"
#include "image/padding.h"
#include "image/write_image.h"
#include "output/lightmap_bytes.h"
#include "output/web_files.h"
#include "output/web_geometry.h"
#include "output/web_probes.h"
#include "output/web_timeline.h"
#include "output/web_transport.h"
#include "relamp/lightmaps.h"
#include "relamp/picture.h"
#include "relight/relighter_state.h"
#include "relight/relit_page.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

namespace relamp
{
namespace
{

using nlohmann::ordered_json;

constexpr int kLightmapQuality = 97; // a step of colour between blocks is seen on an even wall

// Pixels of textures that a phone holds, and of those that are seen first.
constexpr std::array<int, 2> kSides{2048, 1024};

ordered_json arrayOf(glm::vec3 v)
{
    return {v.x, v.y, v.z};
}

/// 1 where a surface covers a pixel of the page.
std::vector<uint8_t> coveredPixels(const Relighter& relighter, size_t p)
{
    std::vector<uint8_t> covered(relighter.room().scan->pages[p].image.pixels());
    for (const uint32_t pixel : relighter.state().texels.pages[p].pixel) covered[pixel] = 1;
    return covered;
}

/// A page of the scan as sRGB, continued into what no surface covers.
std::vector<uint8_t> scannedBytes(const Image& image, std::span<const uint8_t> covered)
{
    std::vector<uint8_t> rgb;
    if (!image.isEncoded()) {
        rgb = srgbBytes(image.half());
    } else if (image.transfer == Transfer::linear) {
        const Radiance radiance(image);
        for (size_t i = 0; i < image.pixels(); ++i)
            for (int c = 0; c < 3; ++c) rgb.push_back(srgbByteFromLinear(radiance[i][c]));
    } else {
        rgb = image.encoded();
    }
    fillPadding(std::span(rgb), covered, image.width, image.height);
    return rgb;
}

/// Whose the texels of a page are, as pictures of bytes: R + 256 G is 1 + the place of the fixture
/// among the room's, 0 none. Pixels beside a surface have what their neighbour has.
std::vector<uint8_t> shiningBytes(const Relighter& relighter, const FixtureMap& map,
                                  std::span<const uint8_t> covered)
{
    const Lights& captured = relighter.room().captured;
    std::vector<uint8_t> rgb(3 * map.id.size());
    const auto put = [&](size_t to, int32_t id) {
        const size_t place = id >= 0 ? captured.placeOf(id) : captured.fixtures.size();
        if (place >= captured.fixtures.size()) return;
        rgb[3 * to] = static_cast<uint8_t>((place + 1) & 255);
        rgb[3 * to + 1] = static_cast<uint8_t>((place + 1) >> 8);
    };
    const auto width = static_cast<size_t>(map.width);
    for (size_t i = 0; i < map.id.size(); ++i) {
        if (covered[i] != 0) {
            put(i, map.id[i]);
            continue;
        }
        for (const size_t from : {i - 1, i + 1, i - width, i + width})
            if (from < map.id.size() && covered[from] != 0) put(i, map.id[from]);
    }
    return rgb;
}

/// What an albedo page shows of what shines: there, no albedo was found.
glm::vec3 meanShiningAlbedo(const Image& albedo, const FixtureMap& map)
{
    const Radiance paint(albedo);
    glm::dvec3 sum(0.0);
    size_t count = 0;
    for (size_t i = 0; i < map.id.size(); ++i) {
        if (map.id[i] < 0) continue;
        sum += glm::dvec3(paint[i]);
        ++count;
    }
    return sum / static_cast<double>(std::max<size_t>(count, 1));
}

/// Sides of lightmaps of which a phone can hold `lights`: 64 MB where they are decoded.
int sideFor(size_t lights, size_t pages)
{
    constexpr size_t kMostPixels = size_t{16} << 20;
    return lights * pages * 1024 * 1024 <= kMostPixels ? 1024 : 512;
}

glm::vec3 colourOf(const LightPart& part)
{
    for (const LitFixture& lit : part.lighting.fixtures)
        if (lit.fixture.radiance != glm::vec3(0.0f)) return lit.fixture.radiance;
    return part.lighting.lights.empty() ? part.lighting.sky.radiance
                                        : part.lighting.lights.front().emission;
}

const char* kindOf(const LightPart& part)
{
    if (part.fixture < 0 && !part.lighting.lights.empty())
        return part.lighting.lights.front().type == LightType::sun ? "sun" : "lamp";
    if (part.name.starts_with("window")) return "window";
    for (const LitFixture& lit : part.lighting.fixtures)
        if (lit.fixture.radiance != glm::vec3(0.0f)) return lit.isWindow ? "window" : "lamp";
    return "sky";
}

/// Writes all of one page, a step at a time.
class PageWriter
{
public:
    PageWriter(Relighter& relighter, const std::filesystem::path& folder,
               const PageOptions& options, Progress& progress)
        : relighter_(relighter), room_(relighter.room()), options_(options), progress_(progress),
          folder_(folder, rulesOfWebPage(options.replacing), progress), pictures_(folder_, progress)
    {}

    WrittenPage write(const Relighting& lighting, const std::vector<LightPart>& parts)
    {
        ordered_json json{{"format", "relamp page 1"}, {"name", room_.scan->name}};
        if (options_.timeline != nullptr) // first, as it may be refused
            json["timeline"] = webTimeline(*options_.timeline, lighting);
        WebGeometry geometry = webGeometry(*room_.scan);
        json["geometry"] =
            writeWebPart(folder_, "geometry", "application/octet-stream", geometry.bytes);
        json["meshes"] = std::move(geometry.meshes);
        json["pages"] = texturesOfPages();
        json["fixtures"] = room_.captured.fixtures.size();
        writePreview(lighting, json);
        json["lights"] = lights(parts);
        writeBounces(json);
        json["probes"] = std::move(probes_);
        copyViewer(options_.viewer, folder_);
        writeRoomScript(folder_, json);
        written_.bytes = bytesOfFiles();
        folder_.commit(std::move(json));
        written_.lights = parts.size();
        return std::move(written_);
    }

private:
    std::string numbered(const char* name, size_t p) const
    {
        return room_.scan->pages.size() == 1 ? name : fmt::format("{}_{}", name, p);
    }

    std::vector<Image> scanned()
    {
        try {
            return readScanned(room_, options_.scan, progress_);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) throw;
            written_.notes.push_back(
                fmt::format("the page does not show the room as it was scanned: {}", error.what()));
            return {};
        }
    }

    ordered_json texturesOfPages()
    {
        ordered_json pages = ordered_json::array();
        const std::vector<Image> scans = scanned();
        for (size_t p = 0; p < room_.scan->pages.size(); ++p) {
            const Image albedo = albedoPage(relighter_.state(), p);
            const std::vector<uint8_t> covered = coveredPixels(relighter_, p);
            ordered_json item;
            item["albedo"] =
                pictures_.texture(numbered("albedo", p),
                                  {srgbBytes(albedo.half()), albedo.width, albedo.height}, kSides);
            if (p < scans.size())
                item["scan"] = pictures_.texture(
                    numbered("scan", p),
                    {scannedBytes(scans[p], covered), scans[p].width, scans[p].height},
                    std::span(kSides).first(1));
            if (p < room_.fixtures.size()) {
                const FixtureMap& map = room_.fixtures[p];
                item["shining"] =
                    pictures_.exact(numbered("shining", p), {shiningBytes(relighter_, map, covered),
                                                             map.width, map.height});
                item["shiningAlbedo"] = arrayOf(meanShiningAlbedo(room_.albedo[p], map));
            }
            pages.push_back(std::move(item));
        }
        return pages;
    }

    /// The first picture, and where and how bright it was taken.
    void writePreview(const Relighting& lighting, ordered_json& json)
    {
        relighter_.light(lighting, progress_);
        const Photographer photographer(relighter_);
        const Camera camera = options_.camera ? *options_.camera : photographer.goodView();
        PictureOptions picture{.view = {.view = View::agx}, .sky = lighting.sky};
        const std::vector<Image> pages = radianceOfPages(relighter_, progress_);
        picture.view.exposure = photographer.automaticExposure(pages, camera, picture, progress_);
        const std::vector<uint8_t> jpeg =
            encodeJpeg(photographer.develop(pages, camera, picture, progress_),
                       {picture.width, picture.height});
        writeFile(folder_ / "preview.jpg", std::as_bytes(std::span(jpeg)));
        const Bounds box = boundsOf(*room_.scan);
        json["exposure"] = picture.view.exposure;
        json["camera"] = {{"position", arrayOf(camera.position)},
                          {"forward", arrayOf(camera.forward)},
                          {"up", arrayOf(camera.up)},
                          {"fieldOfView", camera.fieldOfView},
                          {"across", camera.across == Across::width ? "width" : "height"}};
        json["box"] = {{"low", arrayOf(box.low)}, {"high", arrayOf(box.high)}};
    }

    /// What light that a visitor brings needs to bounce.
    void writeBounces(ordered_json& json)
    {
        const WebTransport transport = webTransport(relighter_);
        json["bounces"] =
            writeWebPart(folder_, "bounces", "application/octet-stream", transport.bytes);
        json["bounces"].update(transport.json);
    }

    ordered_json lights(const std::vector<LightPart>& parts)
    {
        const size_t pages = room_.scan->pages.size();
        const int side = options_.side > 0 ? options_.side : sideFor(parts.size(), pages);
        Progress::Stage stage(progress_, "lightmaps", parts.size());
        ordered_json list = ordered_json::array();
        WebProbes probes(relighter_);
        for (size_t i = 0; i < parts.size(); ++i) {
            progress_.setPart(fmt::format("lightmap {} of {}", i + 1, parts.size()));
            relighter_.light(parts[i].lighting, progress_);
            ordered_json item{{"name", parts[i].name},
                              {"kind", kindOf(parts[i])},
                              {"colour", arrayOf(colourOf(parts[i]))}};
            if (parts[i].fixture >= 0) item["fixture"] = parts[i].fixture;
            item["shines"] = shining();
            item["maps"] = ordered_json::array();
            for (size_t p = 0; p < pages; ++p) {
                const Image map = relighter_.shading(p, side, progress_);
                const float scale = scaleOfLightmap(map.half());
                ordered_json file = pictures_.photo(
                    numbered(fmt::format("light_{:02}", i).c_str(), p),
                    {lightmapBytes(map.half(), scale), map.width, map.height}, kLightmapQuality);
                file["scale"] = scale;
                item["maps"].push_back(std::move(file));
            }
            list.push_back(std::move(item));
            probes.add();
            stage.advance();
        }
        probes_ = writeWebPart(folder_, "probes", "application/octet-stream", probes.bytes());
        probes_.update(probes.json());
        progress_.setPart({});
        return list;
    }

    /// The room's fixtures that shine under the light that was set, by their place.
    [[nodiscard]] ordered_json shining() const
    {
        ordered_json list = ordered_json::array();
        for (const ActiveLight& light : relighter_.state().active.lights) {
            if (!light.isFixture || light.fixture.id < 0) continue;
            const size_t place = room_.captured.placeOf(light.fixture.id);
            if (place < room_.captured.fixtures.size())
                list.push_back({{"place", place}, {"radiance", arrayOf(light.emission)}});
        }
        return list;
    }

    [[nodiscard]] uint64_t bytesOfFiles() const
    {
        const std::filesystem::directory_iterator files((folder_ / "room.js").parent_path());
        return std::accumulate(begin(files), end(files), uint64_t{0},
                               [](uint64_t sum, const std::filesystem::directory_entry& file) {
                                   return sum + file.file_size();
                               });
    }

    Relighter& relighter_;
    const DelitRoom& room_;
    const PageOptions& options_;
    Progress& progress_;
    ListedFolder folder_;
    WebPictureWriter pictures_;
    ordered_json probes_; // what room.js says of them
    WrittenPage written_;
};

} // namespace

void checkPage(const Scan& scan)
{
    for (const Page& page : scan.pages)
        if (page.ofVertices)
            fail(ErrorCode::unsupported, scan.title(),
                 "has colours of vertices, and a page shows textures alone; bake them into a "
                 "texture first");
}

void checkPage(const std::filesystem::path& folder, const PageOptions& options)
{
    checkViewer(options.viewer);
    checkListedFolder(folder, rulesOfWebPage(options.replacing));
}

WrittenPage writePage(Relighter& relighter, const Relighting& lighting,
                      const std::filesystem::path& folder, const PageOptions& options,
                      Progress& progress)
{
    checkViewer(options.viewer);
    checkPage(*relighter.room().scan);
    const std::vector<LightPart> parts = partsOf(lighting, relighter);
    if (parts.empty())
        fail(ErrorCode::unsupported, relighter.room().scan->title(),
             "no light is on, so there is nothing to switch; turn fixtures on, or bring lights");
    return PageWriter(relighter, folder, options, progress).write(lighting, parts);
}

} // namespace relamp
