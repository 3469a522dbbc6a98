#include "scan/page_builder.h"

#include "base/fail.h"
#include "base/half.h"
#include "image/transfer.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr size_t kWidthOfVertexPage = 4096;
constexpr size_t kMostColoredVertices = size_t{1} << 26;

} // namespace

void addVertexPage(Scan& scan, Transfer transfer, const std::string& file)
{
    const auto showsLight = [](const Mesh& mesh) { return mesh.page >= 0 || !mesh.colors.empty(); };
    if (scan.meshes.empty())
        fail(ErrorCode::unsupported, file,
             "has no triangles; relamp needs the surface of a room" +
                 (scan.warnings.empty() ? "" : ".\nIts " + scan.warnings.front()));
    if (std::none_of(scan.meshes.begin(), scan.meshes.end(), showsLight))
        fail(ErrorCode::unsupported, file,
             "has neither textures nor vertex colours, so there is no light in it to take out.\n"
             "Export the scan with its texture.");

    size_t count = 0;
    for (Mesh& mesh : scan.meshes) {
        if (mesh.page >= 0) continue;
        mesh.firstPixel = count;
        count += mesh.positions.size();
    }
    if (count == 0) return;
    if (count > kMostColoredVertices)
        fail(ErrorCode::unsupported, file,
             "has more coloured vertices than relamp works on; simplify it");

    Page page;
    page.name = "vertices";
    page.ofVertices = true;
    const size_t width = std::min(count, kWidthOfVertexPage);
    page.image.width = static_cast<int>(width);
    page.image.height = static_cast<int>((count + width - 1) / width);
    page.image.transfer = Transfer::linear;
    page.image.rgb = std::vector<uint16_t>(3 * page.image.pixels());
    for (Mesh& mesh : scan.meshes) {
        if (mesh.page >= 0) continue;
        mesh.page = static_cast<int>(scan.pages.size());
        uint16_t* rgb = page.image.half().data() + 3 * mesh.firstPixel;
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const float color = mesh.colors.empty() ? 1.0f : mesh.colors[i][c];
                const float linear = transfer == Transfer::srgb ? linearFromSrgb(color) : color;
                *rgb++ = halfFromFloat(std::max(linear, 0.0f) * mesh.factor[c]);
            }
        mesh.factor = glm::vec3(1.0f); // both are in the page now
        mesh.colors.clear();
        mesh.uvs.clear();
    }
    scan.pages.push_back(std::move(page));
}

} // namespace relamp
