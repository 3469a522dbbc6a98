#include "scenes/scenes.h"

#include "base/half.h"
#include "scan/finish_mesh.h"

#include <glm/geometric.hpp>

namespace relamp::scenes
{
namespace
{

constexpr int kPadding = 2; // pixels around each chart

/// A panel and the rectangle of the page that it takes up, in pixels.
struct Wall
{
    Panel panel;
    int column;
    int row;
    glm::ivec2 pixels;
};

Page emptyPage(int width, int height)
{
    Page page;
    page.name = "painted";
    page.image.width = width;
    page.image.height = height;
    page.image.transfer = Transfer::linear;
    page.image.clipsAtWhite = true; // finer than a photo, but white is its end too
    page.image.rgb = std::vector<uint16_t>(3 * page.image.pixels());
    return page;
}

void addWall(Mesh& mesh, Page& page, const Wall& wall, const Paint& paint)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const glm::vec2 size(page.image.width, page.image.height);
    const glm::vec2 low(wall.column, wall.row);
    for (int i = 0; i < 4; ++i) {
        const auto u = static_cast<float>(i % 2);
        const auto v = static_cast<float>(i / 2);
        mesh.positions.push_back(wall.panel.at(u, v));
        mesh.uvs.push_back((low + glm::vec2(u, v) * glm::vec2(wall.pixels)) / size);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first + 1, first + 3, first + 2);

    for (int y = 0; y < wall.pixels.y; ++y)
        for (int x = 0; x < wall.pixels.x; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(wall.pixels.x);
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(wall.pixels.y);
            const glm::vec3 radiance = paint(wall.panel.at(u, v), wall.panel.normal());
            const auto pixel =
                static_cast<size_t>((wall.row + y) * page.image.width + wall.column + x);
            for (int c = 0; c < 3; ++c)
                page.image.half()[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(radiance[c]);
        }
}

Scan scanOf(Mesh mesh, Page page)
{
    Scan scan;
    scan.name = "scene";
    mesh.name = "walls";
    mesh.page = 0;
    finishMesh(mesh, {}, "scene", scan.warnings);
    scan.meshes.push_back(std::move(mesh));
    scan.pages.push_back(std::move(page));
    return scan;
}

} // namespace

Scan square(float side, int pixels, const Paint& paint)
{
    Mesh mesh;
    Page page = emptyPage(pixels, pixels);
    // u along x and v along z would face down; the wall is wound the other way round.
    addWall(mesh, page, {{{0, 0, 0}, {side, 0, 0}, {0, 0, side}}, 0, 0, glm::ivec2(pixels)},
            [&](glm::vec3 p, glm::vec3) {
                return paint(p, {0.0f, 1.0f, 0.0f});
            });
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return scanOf(std::move(mesh), std::move(page));
}

Scan splitSquare(float side, int pixels, const Paint& paint)
{
    const int half = pixels / 2;
    Mesh mesh;
    Page page = emptyPage(2 * (half + 2 * kPadding), pixels + 2 * kPadding);
    const Paint upwards = [&](glm::vec3 p, glm::vec3) { return paint(p, {0.0f, 1.0f, 0.0f}); };
    // The right half comes first on the page, so that the seam's two sides are far apart there.
    const glm::vec3 alongU(0.5f * side, 0, 0);
    const glm::vec3 alongV(0, 0, side);
    addWall(mesh, page, {{alongU, alongU, alongV}, kPadding, kPadding, {half, pixels}}, upwards);
    addWall(mesh, page,
            {{glm::vec3(0), alongU, alongV}, half + 3 * kPadding, kPadding, {half, pixels}},
            upwards);
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return scanOf(std::move(mesh), std::move(page));
}

glm::vec3 Panel::normal() const
{
    return glm::normalize(glm::cross(alongU, alongV));
}

std::vector<Panel> wallsOf(glm::vec3 size)
{
    const glm::vec3 x(size.x, 0, 0);
    const glm::vec3 y(0, size.y, 0);
    const glm::vec3 z(0, 0, size.z);
    return {{glm::vec3(0), z, x}, {y, x, z}, {glm::vec3(0), y, z}, {x, z, y},
            {glm::vec3(0), x, y}, {z, y, x}};
}

Scan panels(std::span<const Panel> panels, int pixels, const Paint& paint)
{
    constexpr int kColumns = 3;
    const int tile = pixels + 2 * kPadding;
    const int rows = (static_cast<int>(panels.size()) + kColumns - 1) / kColumns;
    Mesh mesh;
    Page page = emptyPage(kColumns * tile, rows * tile);
    for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
        const int column = i % kColumns * tile + kPadding;
        const int row = i / kColumns * tile + kPadding;
        addWall(mesh, page, {panels[static_cast<size_t>(i)], column, row, glm::ivec2(pixels)},
                paint);
    }
    return scanOf(std::move(mesh), std::move(page));
}

Scan room(glm::vec3 size, int pixels, const Paint& paint)
{
    return panels(wallsOf(size), pixels, paint);
}

Scan rowOf(const Scan& room, int count, float apart)
{
    Scan row;
    for (int k = 0; k < count; ++k) {
        row.pages.push_back(room.pages.front());
        for (Mesh mesh : room.meshes) {
            mesh.page = k;
            for (glm::vec3& place : mesh.positions) place.x += apart * static_cast<float>(k);
            row.meshes.push_back(std::move(mesh));
        }
    }
    return row;
}

std::shared_ptr<const Scan> copyOf(const Scan& scan)
{
    return std::make_shared<const Scan>(scan);
}

Paint plain(glm::vec3 radiance)
{
    return [radiance](glm::vec3, glm::vec3) { return radiance; };
}

} // namespace relamp::scenes
