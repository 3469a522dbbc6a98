#include "base/fail.h"
#include "base/parallel.h"
#include "relamp/scan.h"
#include "scan/finish_mesh.h"
#include "scan/page_builder.h"
#include "scan/scan_frame.h"
#include "scan/scan_limits.h"

#include <atomic>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

void checkName(const std::string& name)
{
    const std::filesystem::path file(name);
    if (name.empty() || name == "." || name == ".." || file.filename() != file)
        throw Error(ErrorCode::malformed,
                    fmt::format("\"{}\" is no name for a scan: it becomes a file's name", name));
}

void checkScale(double scale, const std::string& scan)
{
    if (!(std::isfinite(scale) && scale > 0.0))
        malformed(scan, fmt::format("its scale is {}; it must be above 0, metres a unit", scale));
}

/// Half floats of light: a sign is negative but for zero's, an exponent of ones infinite or no
/// number.
bool isLight(std::span<const uint16_t> halves)
{
    constexpr uint16_t kInfinity = 0x7c00;
    constexpr uint16_t kMinusZero = 0x8000;
    std::atomic<bool> isGood = true;
    forEachChunk(halves.size(), size_t{1} << 18, [&](size_t begin, size_t end) {
        for (const uint16_t half : halves.subspan(begin, end - begin))
            if (half >= kInfinity && half != kMinusZero) return isGood.store(false);
    });
    return isGood;
}

void checkTexture(const Image& image, const std::string& what)
{
    if (image.width < 1 || image.height < 1)
        malformed(what, fmt::format("is {} x {} pixels", image.width, image.height));
    const size_t values = 3 * image.pixels();
    const size_t has = image.isEncoded() ? image.encoded().size() : image.half().size();
    if (has != values)
        malformed(what, fmt::format("is {} x {} pixels in RGB and has {} values, not {}",
                                    image.width, image.height, has, values));
    if (!image.alpha.empty() && image.alpha.size() != image.pixels())
        malformed(what, fmt::format("has {} values of opacity for {} pixels", image.alpha.size(),
                                    image.pixels()));
    if (image.transfer == Transfer::automatic)
        malformed(what, "has to say whether its numbers are srgb or linear");
    if (!image.isEncoded() && !isLight(image.half()))
        malformed(what, "has values that are no light: negative, infinite or no number");
}

std::vector<Page> pagesOf(std::vector<Image> textures, const std::string& scan)
{
    uint64_t bytes = 0;
    for (const Image& image : textures)
        bytes +=
            image.isEncoded() ? image.encoded().size() : image.half().size() * sizeof(uint16_t);
    PagePixels pixels(textures.size(), bytes, scan);
    std::vector<Page> pages;
    for (Image& image : textures) {
        std::string name = fmt::format("texture {}", pages.size());
        checkTexture(image, fmt::format("{}: {}", scan, name));
        pixels.add(image.pixels());
        pages.push_back({std::move(name), std::move(image)});
    }
    return pages;
}

void checkSurface(const SurfaceArrays& surface, size_t textures, const std::string& what)
{
    const size_t count = surface.positions.size();
    const bool isTextured = surface.texture != -1;
    if (isTextured && (surface.texture < 0 || static_cast<size_t>(surface.texture) >= textures))
        malformed(what,
                  fmt::format("shows texture {}, and there are {}", surface.texture, textures));
    if (isTextured && surface.uvs.empty())
        malformed(what, "has a texture and no texture coordinates");
    if (!surface.normals.empty() && surface.normals.size() != count)
        malformed(what,
                  fmt::format("has {} normals for {} positions", surface.normals.size(), count));
}

template<class Value>
std::vector<Value> copyOf(std::span<const Value> values)
{
    return {values.begin(), values.end()};
}

void add(const SurfaceArrays& surface, const std::string& title, Scan& scan)
{
    checkSurface(surface, scan.pages.size(), fmt::format("{}: mesh \"{}\"", title, surface.name));
    Mesh mesh{.name = surface.name, .page = surface.texture};
    mesh.positions.reserve(surface.positions.size());
    for (const glm::vec3& position : surface.positions)
        mesh.positions.emplace_back(scan.worldFromFile * glm::vec4(position, 1.0f));
    std::vector<glm::vec3> normals;
    normals.reserve(surface.normals.size());
    for (const glm::vec3& normal : surface.normals)
        normals.push_back(glm::mat3(scan.worldFromFile) * normal);
    mesh.triangles = copyOf(surface.triangles);
    mesh.uvs = copyOf(surface.uvs);
    mesh.colors = copyOf(surface.colors);
    finishMesh(mesh, std::move(normals), title, scan.warnings);
    if (!mesh.triangles.empty()) scan.meshes.push_back(std::move(mesh));
}

} // namespace

Scan makeScan(const std::string& name, std::span<const SurfaceArrays> surfaces,
              std::vector<Image> textures, const ScanOptions& options)
{
    checkName(name);
    checkScale(options.scale, name);
    Scan scan;
    scan.name = name;
    scan.options = options;
    scan.worldFromFile = worldFromFile(options);
    scan.pages = pagesOf(std::move(textures), name);
    SkippedMeshes skipped(options);
    for (const SurfaceArrays& surface : surfaces)
        if (!skipped.holds(surface.name)) add(surface, name, scan);
    addVertexPage(scan, Transfer::linear, name);
    skipped.tell(scan.warnings);
    checkCounts(scan, name);
    shortenWarnings(scan.warnings);
    return options.longestSide > 0 ? coarsened(std::move(scan), options.longestSide)
                                   : std::move(scan);
}

} // namespace relamp
