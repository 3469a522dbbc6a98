#include "output/usd_scene.h"

#include "output/usd_text.h"
#include "relamp/version.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr const char* kRoom = "/Room";
constexpr float kAngleOfSun = 0.53f; // degrees across

float brightest(glm::vec3 light)
{
    return std::max({light.r, light.g, light.b});
}

class SceneWriter
{
public:
    SceneWriter(const std::filesystem::path& file, const Scan& scan,
                const std::vector<UsdPage>& pages, const UsdLights& lights)
        : text_(file), scan_(scan), pages_(pages), lights_(lights)
    {}

    void write();

private:
    using Look = std::tuple<int, Wrap, Wrap>; // page, and how its texture goes on

    void writeHead();
    void writeMeshes();
    void writeMesh(const Mesh& mesh, const std::string& name);
    void writeNormals(const Mesh& mesh);
    void writeColors(const Mesh& mesh);
    void nameMaterials();
    void writeMaterials();
    void writeMaterial(const Look& look, const std::string& name);
    void writeTexture(const Look& look, const std::string& material, const char* name,
                      const std::string& file, const char* colorSpace);
    void writeReader(const char* name, const char* type, const char* primvar);
    void writeVariants();
    void writeGlow();
    void writeLights();
    void writeLamp(const SimpleLamp& lamp);
    void writeSun(const Sun& sun);
    void writeBrightness(glm::vec3 light);
    void writePlace(const glm::mat3& axes, glm::vec3 position);
    [[nodiscard]] const UsdPage& pageOf(const Look& look) const
    {
        return pages_[static_cast<size_t>(std::get<0>(look))];
    }
    [[nodiscard]] bool shines(const Look& look) const
    {
        return !pageOf(look).emission.empty() || !pageOf(look).vertexEmission.empty();
    }

    UsdText text_;
    const Scan& scan_;
    const std::vector<UsdPage>& pages_;
    const UsdLights& lights_;
    std::map<Look, std::string> materials_; // by name
    PrimNames lightNames_;
};

void SceneWriter::writeHead()
{
    text_.line("#usda 1.0");
    text_.line("(");
    text_.line("    customLayerData = {");
    text_.line("        string creator = " + usdString(std::string("relamp ") + version()));
    text_.line("    }");
    text_.line("    defaultPrim = \"Room\"");
    text_.line("    doc = \"A scanned room without its light, and the light. Radiance 1 is the "
               "white of the scan's texture.\"");
    text_.line("    metersPerUnit = 1");
    text_.line("    upAxis = \"Y\"");
    text_.line(")");
    text_.line("");
}

/// Where all corners of a vertex have one normal, one a vertex does.
void SceneWriter::writeNormals(const Mesh& mesh)
{
    std::vector<glm::vec3> ofVertices(mesh.positions.size(), glm::vec3(0.0f));
    bool isOne = true;
    for (size_t t = 0; t < mesh.triangles.size() && isOne; ++t)
        for (int c = 0; c < 3; ++c) {
            glm::vec3& known = ofVertices[mesh.triangles[t][c]];
            const glm::vec3 normal = mesh.normals[3 * t + static_cast<size_t>(c)];
            isOne = isOne && (known == glm::vec3(0.0f) || known == normal);
            known = normal;
        }
    text_.array("normal3f[] normals", isOne ? ofVertices : mesh.normals);
    text_.interpolation(isOne ? "vertex" : "faceVarying");
}

/// Of a mesh on a page of vertices, linear.
void SceneWriter::writeColors(const Mesh& mesh)
{
    const auto write = [&](const char* head, const std::vector<float>& ofPage) {
        if (ofPage.empty()) return;
        std::vector<glm::vec3> colors;
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            const float* rgb = &ofPage[3 * (mesh.firstPixel + v)];
            colors.emplace_back(rgb[0], rgb[1], rgb[2]);
        }
        text_.array(head, colors);
        text_.interpolation("vertex");
    };
    const UsdPage& page = pages_[static_cast<size_t>(mesh.page)];
    write("color3f[] primvars:displayColor", page.vertexAlbedo);
    write("color3f[] primvars:emission", page.vertexEmission);
}

void SceneWriter::writeMesh(const Mesh& mesh, const std::string& name)
{
    text_.line(fmt::format("def Mesh \"{}\" (", name));
    text_.line("    customData = {");
    text_.line("        string name = " + usdString(mesh.name));
    text_.line("    }");
    text_.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    text_.open(")");
    glm::vec3 low = mesh.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    text_.array("float3[] extent", std::array{low, high});
    text_.array("int[] faceVertexCounts", mesh.triangles.size(), 3);
    text_.array("int[] faceVertexIndices", mesh.triangles);
    text_.line(fmt::format("rel material:binding = <{}/Materials/{}>", kRoom,
                           materials_[{mesh.page, mesh.wrapU, mesh.wrapV}]));
    writeNormals(mesh);
    text_.array("point3f[] points", mesh.positions);
    writeColors(mesh);
    if (!mesh.uvs.empty()) {
        std::vector<glm::vec2> st; // t goes upwards
        for (const glm::vec2& uv : mesh.uvs) st.emplace_back(uv.x, 1.0f - uv.y);
        text_.array("texCoord2f[] primvars:st", st);
        text_.interpolation("vertex");
    }
    text_.line("uniform token subdivisionScheme = \"none\"");
    text_.close();
}

void SceneWriter::writeMeshes()
{
    text_.open("def Scope \"Geometry\"");
    PrimNames names;
    for (const Mesh& mesh : scan_.meshes) {
        const std::string name = names.take(mesh.name);
        if (!mesh.triangles.empty()) writeMesh(mesh, name);
    }
    text_.close();
}

void SceneWriter::nameMaterials()
{
    PrimNames names;
    for (const Mesh& mesh : scan_.meshes) {
        const auto [material, isNew] = materials_.try_emplace({mesh.page, mesh.wrapU, mesh.wrapV});
        if (isNew) material->second = names.take(fmt::format("page_{}", mesh.page));
    }
}

void SceneWriter::writeTexture(const Look& look, const std::string& material, const char* name,
                               const std::string& file, const char* colorSpace)
{
    constexpr std::array kWraps{"repeat", "mirror", "clamp"};
    text_.open(fmt::format("def Shader \"{}\"", name));
    text_.line("uniform token info:id = \"UsdUVTexture\"");
    text_.line(fmt::format("asset inputs:file = @./{}@", file));
    text_.line(fmt::format("token inputs:sourceColorSpace = \"{}\"", colorSpace));
    text_.line(fmt::format("float2 inputs:st.connect = <{}/Materials/{}/st.outputs:result>", kRoom,
                           material));
    text_.line(
        fmt::format("token inputs:wrapS = \"{}\"", kWraps[static_cast<size_t>(std::get<1>(look))]));
    text_.line(
        fmt::format("token inputs:wrapT = \"{}\"", kWraps[static_cast<size_t>(std::get<2>(look))]));
    text_.line("float outputs:a");
    text_.line("float3 outputs:rgb");
    text_.close();
}

void SceneWriter::writeReader(const char* name, const char* type, const char* primvar)
{
    text_.open(fmt::format("def Shader \"{}\"", name));
    text_.line(fmt::format("uniform token info:id = \"UsdPrimvarReader_{}\"", type));
    text_.line(fmt::format("string inputs:varname = \"{}\"", primvar));
    text_.line(fmt::format("{} outputs:result", type));
    text_.close();
}

/// Matte, as relamp takes all surfaces to be: without the specular part that a surface has by its
/// index of refraction.
void SceneWriter::writeMaterial(const Look& look, const std::string& name)
{
    const UsdPage& page = pageOf(look);
    const bool isTextured = !page.albedo.empty();
    const std::string path = fmt::format("{}/Materials/{}", kRoom, name);
    text_.open(fmt::format("def Material \"{}\"", name));
    text_.line(fmt::format("token outputs:surface.connect = <{}/surface.outputs:surface>", path));
    text_.open("def Shader \"surface\"");
    text_.line("uniform token info:id = \"UsdPreviewSurface\"");
    text_.line(fmt::format("color3f inputs:diffuseColor.connect = <{}/albedo.outputs:{}>", path,
                           isTextured ? "rgb" : "result"));
    if (page.hasOpacity)
        text_.line(fmt::format("float inputs:opacity.connect = <{}/albedo.outputs:a>", path));
    text_.line("float inputs:roughness = 1");
    text_.line("color3f inputs:specularColor = (0, 0, 0)");
    text_.line("int inputs:useSpecularWorkflow = 1");
    text_.line("token outputs:surface");
    text_.close();
    if (isTextured) {
        writeReader("st", "float2", "st");
        writeTexture(look, name, "albedo", page.albedo, "sRGB");
        if (shines(look)) writeTexture(look, name, "emission", page.emission, "raw");
    } else {
        writeReader("albedo", "float3", "displayColor");
        if (shines(look)) writeReader("emission", "float3", "emission");
    }
    text_.close();
}

void SceneWriter::writeMaterials()
{
    text_.open("def Scope \"Materials\"");
    for (const auto& [look, name] : materials_) writeMaterial(look, name);
    text_.close();
}

void SceneWriter::writeBrightness(glm::vec3 light)
{
    const float most = brightest(light);
    text_.line("color3f inputs:color = " + usd(light / most));
    text_.line("float inputs:intensity = " + usd(most));
}

void SceneWriter::writePlace(const glm::mat3& axes, glm::vec3 position)
{
    const auto row = [](glm::vec3 v, int last) {
        return fmt::format("({}, {}, {}, {})", usd(v.x), usd(v.y), usd(v.z), last);
    };
    text_.line(fmt::format("matrix4d xformOp:transform = ({}, {}, {}, {})", row(axes[0], 0),
                           row(axes[1], 0), row(axes[2], 0), row(position, 1)));
    text_.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
}

/// An intensity is radiance where nothing else is said, and what knows no more of the schema takes
/// it for that.
void SceneWriter::writeLamp(const SimpleLamp& lamp)
{
    constexpr std::array kTypes{"RectLight", "DiskLight", "SphereLight"};
    text_.line(fmt::format("def {} \"{}\" (", kTypes[static_cast<size_t>(lamp.shape)],
                           lightNames_.take(lamp.name)));
    text_.line("    customData = {");
    if (lamp.id >= 0) text_.line(fmt::format("        int fixture = {}", lamp.id));
    text_.line(fmt::format("        string name = {}", usdString(lamp.name)));
    text_.line("    }");
    text_.open(")");
    writeBrightness(lamp.emission / lamp.area());
    if (lamp.shape == LampShape::rectangle) {
        text_.line("float inputs:height = " + usd(lamp.height));
        text_.line("float inputs:width = " + usd(lamp.width));
    } else {
        text_.line("float inputs:radius = " + usd(lamp.radius));
    }
    writePlace(lamp.axes, lamp.position);
    text_.close();
}

/// With `normalize`, intensity is irradiance on what faces the sun.
void SceneWriter::writeSun(const Sun& sun)
{
    text_.open(fmt::format("def DistantLight \"{}\"", lightNames_.take("sun")));
    text_.line("float inputs:angle = " + usd(kAngleOfSun));
    writeBrightness(sun.irradiance);
    text_.line("bool inputs:normalize = 1");
    const glm::vec3 back = glm::normalize(sun.direction);
    const glm::vec3 side = std::abs(back.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(side, back));
    writePlace({right, glm::cross(back, right), back}, glm::vec3(0.0f));
    text_.close();
}

void SceneWriter::writeLights()
{
    text_.open("def Scope \"Lights\"");
    if (lights_.outside != glm::vec3(0.0f)) {
        text_.open(fmt::format("def DomeLight \"{}\"", lightNames_.take("outside")));
        writeBrightness(lights_.outside);
        text_.close();
    }
    if (lights_.sun) writeSun(*lights_.sun);
    for (const SimpleLamp& opening : lights_.openings) writeLamp(opening);
    text_.close();
    text_.open("def Scope \"Lamps\"");
    for (const SimpleLamp& lamp : lights_.lamps) writeLamp(lamp);
    text_.close();
}

void SceneWriter::writeGlow()
{
    text_.open("over \"Materials\"");
    for (const auto& [look, name] : materials_) {
        if (!shines(look)) continue;
        text_.open(fmt::format("over \"{}\"", name));
        text_.open("over \"surface\"");
        text_.line(fmt::format("color3f inputs:emissiveColor.connect = "
                               "<{}/Materials/{}/emission.outputs:{}>",
                               kRoom, name, pageOf(look).emission.empty() ? "result" : "rgb"));
        text_.close();
        text_.close();
    }
    text_.close();
}

/// The lamps stand outside of the variants, so that programs that know none have them.
void SceneWriter::writeVariants()
{
    text_.openHere("variantSet \"light\" =");
    text_.openHere("\"emissive\"");
    text_.line("over \"Lamps\" (");
    text_.line("    active = false");
    text_.open(")");
    text_.close();
    writeGlow();
    text_.close();
    text_.openHere("\"lamps\"");
    text_.close();
    text_.close();
}

void SceneWriter::write()
{
    writeHead();
    text_.line("def Xform \"Room\" (");
    text_.line("    kind = \"component\"");
    text_.line("    prepend variantSets = \"light\"");
    text_.line("    variants = {");
    text_.line("        string light = \"lamps\"");
    text_.line("    }");
    text_.open(")");
    nameMaterials();
    writeMeshes();
    writeMaterials();
    writeLights();
    writeVariants();
    text_.close();
    text_.finish();
}

} // namespace

void writeUsdScene(const std::filesystem::path& file, const Scan& scan,
                   const std::vector<UsdPage>& pages, const UsdLights& lights)
{
    SceneWriter(file, scan, pages, lights).write();
}

} // namespace relamp
