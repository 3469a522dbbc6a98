#include "scan/facets.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr double kLeastPixelArea = 1e-6; // of a triangle on its page; thinner ones cover no centre

/// Gradients over a triangle's pixels of something known at its corners.
struct PixelGradients
{
    explicit PixelGradients(const PixelTriangle& t)
    {
        const glm::dvec2 e1 = t.corner[1] - t.corner[0];
        const glm::dvec2 e2 = t.corner[2] - t.corner[0];
        const double twiceArea = e1.x * e2.y - e1.y * e2.x;
        isFlat = !(std::abs(twiceArea) > 2.0 * kLeastPixelArea);
        if (isFlat) return;
        barycentricX = glm::dvec2(e2.y, -e1.y) / twiceArea;
        barycentricY = glm::dvec2(-e2.x, e1.x) / twiceArea;
    }

    [[nodiscard]] glm::vec3 alongX(const std::array<glm::dvec3, 3>& v) const
    {
        return barycentricX.x * (v[1] - v[0]) + barycentricX.y * (v[2] - v[0]);
    }
    [[nodiscard]] glm::vec3 alongY(const std::array<glm::dvec3, 3>& v) const
    {
        return barycentricY.x * (v[1] - v[0]) + barycentricY.y * (v[2] - v[0]);
    }

    bool isFlat = true;
    glm::dvec2 barycentricX{0.0}; // change of the weights of corners 1 and 2 a column
    glm::dvec2 barycentricY{0.0}; // and a row
};

Facet facetOfTriangle(const Scan& scan, uint32_t meshIndex, size_t triangle)
{
    const Mesh& mesh = scan.meshes[meshIndex];
    const glm::uvec3& v = mesh.triangles[triangle];
    const std::array<glm::dvec3, 3> positions{mesh.positions[v.x], mesh.positions[v.y],
                                              mesh.positions[v.z]};
    const std::array<glm::dvec3, 3> normals{
        mesh.normals[3 * triangle], mesh.normals[3 * triangle + 1], mesh.normals[3 * triangle + 2]};
    Facet facet;
    facet.position = positions[0];
    facet.normal = normals[0];
    if (mesh.uvs.empty()) return facet;
    const PixelTriangle pixels = pixelTriangle(scan, mesh, v);
    const PixelGradients gradients(pixels);
    if (gradients.isFlat) return facet;
    facet.pixel = pixels.corner[0];
    facet.positionX = gradients.alongX(positions);
    facet.positionY = gradients.alongY(positions);
    facet.normalX = gradients.alongX(normals);
    facet.normalY = gradients.alongY(normals);
    facet.texelArea = glm::length(glm::cross(facet.positionX, facet.positionY));
    return facet;
}

/// A vertex stands for a third of every triangle around it. Where sheets lie back to back it faces
/// as the first of them: what faces away is left out of the mean, which would be none otherwise.
void addVertexFacets(const Scan& scan, uint32_t meshIndex, std::vector<Facet>& facets)
{
    const Mesh& mesh = scan.meshes[meshIndex];
    std::vector<Facet> vertices(mesh.positions.size());
    for (size_t i = 0; i < vertices.size(); ++i) vertices[i].position = mesh.positions[i];
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& v = mesh.triangles[i];
        const glm::vec3 a = mesh.positions[v.x];
        const float area =
            0.5f * glm::length(glm::cross(mesh.positions[v.y] - a, mesh.positions[v.z] - a));
        for (int c = 0; c < 3; ++c) {
            Facet& vertex = vertices[v[c]];
            vertex.texelArea += area / 3.0f;
            const glm::vec3 normal = mesh.normals[3 * i + static_cast<size_t>(c)];
            if (glm::dot(vertex.normal, normal) >= 0.0f) vertex.normal += area * normal;
        }
    }
    facets.insert(facets.end(), vertices.begin(), vertices.end());
}

double wholePages(double coordinate)
{
    return std::floor(coordinate);
}

/// Texture coordinate -> pixel, for a triangle whose centroid lies on tile `tile` of the plane.
double pixelFrom(double coordinate, double tile, Wrap wrap, int size)
{
    double onPage = wrap == Wrap::clamp ? coordinate : coordinate - tile;
    if (wrap == Wrap::mirror && std::fmod(std::abs(tile), 2.0) == 1.0) onPage = 1.0 - onPage;
    return onPage * size - 0.5;
}

} // namespace

TexelSite siteOn(const Facet& facet, glm::vec2 pixel)
{
    constexpr float kCancelled = 1e-6f; // length of a mean of unit normals
    float place[8];
    placeOn(facet, pixel, place);
    const glm::vec3 normal(place[3], place[4], place[5]);
    const float squared = glm::dot(normal, normal);
    return {{place[0], place[1], place[2]},
            squared > kCancelled * kCancelled ? normal * (1.0f / std::sqrt(squared))
                                              : glm::normalize(facet.normal)};
}

PixelTriangle pixelTriangle(const Scan& scan, const Mesh& mesh, const glm::uvec3& triangle)
{
    const Image& image = scan.pages[static_cast<size_t>(mesh.page)].image;
    const glm::dvec2 uv[3] = {mesh.uvs[triangle.x], mesh.uvs[triangle.y], mesh.uvs[triangle.z]};
    const glm::dvec2 centroid = (uv[0] + uv[1] + uv[2]) / 3.0;
    const double tileU = wholePages(centroid.x);
    const double tileV = wholePages(centroid.y);
    PixelTriangle pixels{};
    for (int c = 0; c < 3; ++c)
        pixels.corner[c] = {pixelFrom(uv[c].x, tileU, mesh.wrapU, image.width),
                            pixelFrom(uv[c].y, tileV, mesh.wrapV, image.height)};
    return pixels;
}

Facets buildFacets(const Scan& scan)
{
    Facets result;
    result.triangles = scan.triangleCount();
    result.facets.resize(result.triangles);
    for (uint32_t m = 0, first = 0; m <= scan.meshes.size(); ++m) {
        result.firstOfMesh.push_back(first);
        if (m == scan.meshes.size()) break;
        first += static_cast<uint32_t>(scan.meshes[m].triangles.size());
        result.meshOf.resize(first, m);
    }
    for (uint32_t m = 0; m < scan.meshes.size(); ++m)
        forEachChunk(scan.meshes[m].triangles.size(), 2048, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                result.facets[result.firstOfMesh[m] + i] = facetOfTriangle(scan, m, i);
        });
    for (uint32_t m = 0; m < scan.meshes.size(); ++m)
        if (scan.pages[static_cast<size_t>(scan.meshes[m].page)].ofVertices) {
            addVertexFacets(scan, m, result.facets);
            result.meshOf.resize(result.facets.size(), m);
        }
    return result;
}

Tint tintOf(const Scan& scan, const Facets& facets, uint32_t facet)
{
    const uint32_t meshIndex = facets.meshOf[facet];
    const Mesh& mesh = scan.meshes[meshIndex];
    Tint tint{.color = mesh.factor};
    if (facet >= facets.triangles || mesh.colors.empty()) return tint;
    const glm::uvec3& v = mesh.triangles[facet - facets.firstOfMesh[meshIndex]];
    const PixelGradients gradients(pixelTriangle(scan, mesh, v));
    const std::array<glm::dvec3, 3> colors{mesh.factor * mesh.colors[v.x],
                                           mesh.factor * mesh.colors[v.y],
                                           mesh.factor * mesh.colors[v.z]};
    return {colors[0], gradients.alongX(colors), gradients.alongY(colors)};
}

} // namespace relamp
