#include "rooms/write_room.h"

#include "base/file.h"
#include "base/half.h"
#include "base/json.h"
#include "image/transfer.h"
#include "image/write_image.h"
#include "rooms/reconstruct.h"
#include "scan/gltf_write.h"

#include <algorithm>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp::rooms
{
namespace
{

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr float kOmni = 0.5f; // length of a lamp's mean normal up to which it shines all around

Size sizeOf(const Atlas& atlas)
{
    return {atlas.side, atlas.side};
}

void writePng(const fs::path& file, std::span<const uint8_t> samples, const Atlas& atlas,
              int channels)
{
    const std::vector<uint8_t> png = encodePng(samples, sizeOf(atlas), channels);
    writeFile(file, std::as_bytes(std::span(png)));
}

void writeLayer(const fs::path& file, const Atlas& atlas, const std::vector<glm::vec3>& layer,
                glm::vec3 scale)
{
    std::vector<uint16_t> half;
    half.reserve(3 * layer.size());
    for (const glm::vec3& rgb : layer)
        for (int c = 0; c < 3; ++c) half.push_back(halfFromFloat(scale[c] * rgb[c]));
    writeExr(file, half, sizeOf(atlas));
}

ordered_json json(glm::vec3 v)
{
    return {shortest(v.x), shortest(v.y), shortest(v.z)};
}

/// Centre, area and mean normal of what is there of a lamp.
ordered_json lampJson(const FinishedRoom& made, const Mesh& mesh, int lamp)
{
    glm::vec3 centre(0.0f);
    glm::vec3 normal(0.0f);
    float area = 0.0f;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        const glm::vec3 cross = 0.5f * glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        centre += glm::length(cross) * (a + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
        normal += cross;
        area += glm::length(cross);
    }
    const Lamp& source = made.room.lamps[static_cast<size_t>(lamp)];
    normal /= area;
    const bool isOmni = glm::length(normal) < kOmni;
    return {{"kind", source.kind},
            {"center", json(centre / area)},
            {"area", shortest(area)},
            {"normal", isOmni ? ordered_json("omni") : json(glm::normalize(normal))},
            {"radiance", json(made.photo.scale * source.radiance)}};
}

std::string lightsJson(const FinishedRoom& made)
{
    const ChartMesh all = meshOf(made.atlas, kWhole);
    const Mesh& mesh = all.scan.meshes[0];
    ordered_json lights = ordered_json::array();
    for (int lamp = 0; lamp < static_cast<int>(made.room.lamps.size()); ++lamp) {
        Mesh part;
        part.positions = mesh.positions;
        for (size_t t = 0; t < mesh.triangles.size(); ++t)
            if (made.atlas.charts[all.chartOf[t]].patch.lamp == lamp)
                part.triangles.push_back(mesh.triangles[t]);
        lights.push_back(lampJson(made, part, lamp));
    }
    return textOf({{"axes", "glTF, Y up, metres"},
                   {"units", "radiance; 1.0 = clip level of the texture"},
                   {"lights", lights}});
}

std::string metaJson(const FinishedRoom& made, size_t triangles)
{
    size_t covered = 0;
    size_t hidden = 0;
    size_t inMask = 0;
    size_t burnt = 0;
    for (size_t p = 0; p < made.atlas.pixels(); ++p) {
        covered += made.baked.isCovered[p];
        hidden += made.baked.isHidden[p];
        if (made.photo.mask[p] == 0) continue;
        ++inMask;
        const glm::vec3 seen = made.photo.scale * made.baked.radiance(p);
        burnt += std::max({seen.r, seen.g, seen.b}) >= 1.0f ? 1u : 0u;
    }
    return textOf({{"room", made.plan.name},
                   {"seed", made.plan.seed},
                   {"resolution", made.atlas.side},
                   {"triangles", triangles},
                   {"charts", made.atlas.charts.size()},
                   {"fixtures", made.room.lamps.size()},
                   {"coveredTexels", covered},
                   {"hiddenTexels", hidden},
                   {"scoredTexels", inMask},
                   {"clippedInMask", static_cast<double>(burnt) / static_cast<double>(inMask)},
                   {"scale", json(made.photo.scale)},
                   {"convention", "radiance = albedo * shading + emission; shading = irradiance / "
                                  "pi; linear Rec. 709; row 0 of an image is v = 0 (glTF)"}});
}

void writeTruth(const FinishedRoom& made, const std::vector<uint8_t>& mask, const fs::path& folder)
{
    const Baked& baked = made.baked;
    const glm::vec3 scale = made.photo.scale;
    std::vector<glm::vec3> shading(baked.direct.size());
    for (size_t p = 0; p < shading.size(); ++p) shading[p] = baked.direct[p] + baked.indirect[p];
    writeLayer(folder / "gt_albedo.exr", made.atlas, baked.albedo, glm::vec3(1.0f));
    writeLayer(folder / "gt_shading.exr", made.atlas, shading, scale);
    writeLayer(folder / "gt_direct.exr", made.atlas, baked.direct, scale);
    writeLayer(folder / "gt_indirect.exr", made.atlas, baked.indirect, scale);
    writePng(folder / "mask.png", mask, made.atlas, 1);
    writeFile(folder / "gt_lights.json", lightsJson(made));
}

void writeScan(const fs::path& file, const ChartMesh& mesh, EncodedImage texture)
{
    writeFile(file, writeUnlitGlb(mesh.scan, {{.albedo = std::move(texture)}}));
}

/// The mask without what lies in a mesh's holes.
std::vector<uint8_t> maskOn(const FinishedRoom& made, const ChartMesh& mesh)
{
    std::vector<uint8_t> mask(made.atlas.pixels(), 0);
    const Mesh& surface = mesh.scan.meshes[0];
    const auto side = static_cast<float>(made.atlas.side);
    for (const glm::uvec3& t : surface.triangles) { // half a cell of a chart's grid
        const glm::vec2 low =
            glm::min(glm::min(surface.uvs[t.x], surface.uvs[t.y]), surface.uvs[t.z]);
        const glm::vec2 high =
            glm::max(glm::max(surface.uvs[t.x], surface.uvs[t.y]), surface.uvs[t.z]);
        const glm::ivec2 first(glm::ceil(low * side - 0.5f));
        const glm::ivec2 end(glm::ceil(high * side - 0.5f));
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                const auto pixel = static_cast<size_t>(y * made.atlas.side + x);
                mask[pixel] = made.photo.mask[pixel];
            }
    }
    return mask;
}

} // namespace

void writeRoom(const FinishedRoom& made, const fs::path& folder)
{
    fs::create_directories(folder);
    const ChartMesh mesh = meshOf(made.atlas, kWhole);
    const std::vector<uint8_t> png = encodePng(made.photo.encoded, sizeOf(made.atlas), 3);
    writeFile(folder / "scan.png", std::as_bytes(std::span(png)));
    writeScan(folder / "scan.glb", mesh, {png, "image/png"});
    writeLayer(folder / "scan_hdr.exr", made.atlas, made.photo.seen, glm::vec3(1.0f));
    writeTruth(made, made.photo.mask, folder);
    writeFile(folder / "meta.json", metaJson(made, mesh.scan.triangleCount()));
}

void writeReconstruction(const FinishedRoom& made, const fs::path& folder)
{
    fs::create_directories(folder);
    const ChartMesh mesh = reconstructed(made.atlas, {.seed = made.plan.seed});
    const std::vector<uint8_t> jpeg = encodeJpeg(made.photo.encoded, sizeOf(made.atlas));
    writeFile(folder / "scan_recon.jpg", std::as_bytes(std::span(jpeg)));
    writeScan(folder / "scan_recon.glb", mesh, {jpeg, "image/jpeg"});
    writeLayer(folder / "scan_recon_hdr.exr", made.atlas, made.photo.seen, glm::vec3(1.0f));
    writeTruth(made, maskOn(made, mesh), folder);
    writeFile(folder / "meta.json", metaJson(made, mesh.scan.triangleCount()));
}

void writeSmall(const FinishedRoom& made, const fs::path& folder)
{
    fs::create_directories(folder);
    const std::vector<uint8_t> png = encodePng(made.photo.encoded, sizeOf(made.atlas), 3);
    writeScan(folder / "scan.glb", meshOf(made.atlas, kWhole), {png, "image/png"});
    std::vector<uint8_t> albedo(3 * made.atlas.pixels(), 0);
    for (size_t p = 0; p < made.atlas.pixels(); ++p)
        for (int c = 0; c < 3 && made.photo.mask[p] != 0; ++c)
            albedo[3 * p + static_cast<size_t>(c)] = srgbByteFromLinear(made.baked.albedo[p][c]);
    writePng(folder / "gt_albedo.png", albedo, made.atlas, 3);
    writeFile(folder / "gt_lights.json", lightsJson(made));
}

} // namespace relamp::rooms
