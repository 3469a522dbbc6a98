// Writes small good files of every kind, a folder a fuzz target, into the folder that it is given.

#include "base/file.h"
#include "base/half.h"
#include "fuzz/result_files.h"
#include "image/transfer.h"
#include "image/write_image.h"
#include "relamp/relight.h"
#include "relamp/result.h"
#include "scan/gltf_write.h"
#include "scenes/gltf_files.h"
#include "scenes/pictures.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{

using namespace relamp;
using namespace relamp::scenes;

class Seeds
{
public:
    explicit Seeds(const std::filesystem::path& folder) : folder_(folder) {}

    void add(const std::string& target, const std::string& bytes)
    {
        std::filesystem::create_directories(folder_ / target);
        std::ofstream(folder_ / target / std::to_string(count_++), std::ios::binary) << bytes;
    }
    void add(const std::string& target, const Bytes& bytes)
    {
        add(target, std::string(bytes.begin(), bytes.end()));
    }

private:
    std::filesystem::path folder_;
    int count_ = 0;
};

GltfFile sparseSquare()
{
    GltfFile file = coloredSquare();
    const size_t at = file.addView(bytesOf(std::vector<uint16_t>{1}));
    const size_t values = file.addView(bytesOf(std::vector<glm::vec3>{{2, 0, 0}}));
    file.accessorOf("POSITION")["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", at}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    file.addNode({{"mesh", 0}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, -1, 1}}});
    return file;
}

GltfFile richSquare()
{
    GltfFile file = texturedSquare();
    file.material()["extensions"] = {
        {"KHR_materials_unlit", nlohmann::json::object()},
        {"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}};
    file.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                   ["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", 0.5}, {"scale", {0.5, 0.5}}, {"texCoord", 0}};
    file.material()["emissiveTexture"]["index"] = 0;
    file.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    file.document["textures"][0]["sampler"] = 0;
    file.document["extensionsUsed"] = {"KHR_materials_unlit", "KHR_texture_transform",
                                       "KHR_materials_emissive_strength", "KHR_lights_punctual"};
    file.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", nlohmann::json::object()}}};
    return file;
}

void addGltf(Seeds& seeds)
{
    const std::vector files{texturedSquare(), coloredSquare(), dracoSquare(),
                            meshoptSquare(),  sparseSquare(),  richSquare()};
    for (const GltfFile& file : files) seeds.add("gltf", file.glb());
    seeds.add("gltf", coloredSquare().gltf("data:;base64,AAAAAAAAAAAAAIA/AACAPwAAgD8="));
    seeds.add("gltf", sparseSquare().gltf("gone.bin"));
    GltfFile corners; // all in the text: nine floats of positions, no other bytes
    corners.addAccessor(Bytes(36), 3, {});
    corners.addMesh({{"POSITION", 0}, {"COLOR_0", 0}});
    corners.addNode({{"mesh", 0}});
    corners.document["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    seeds.add("gltf",
              corners.gltf("data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"));
}

void addPly(Seeds& seeds)
{
    const std::string vertices =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    seeds.add("ply", "ply\nformat ascii 1.0\n" + vertices + colors + faces +
                         "end_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n");
    seeds.add("ply", "ply\nformat ascii 1.0\ncomment TextureFile a.png\n" + vertices + faces +
                         "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
                         "0 0 0 1 0 0 0 1 0\n3 0 1 2 6 0 0 1 0 0 1 0\n");
    for (const char* order : {"little", "big"})
        seeds.add("ply", "ply\r\nformat binary_" + std::string(order) +
                             "_endian 1.0\r\nelement vertex 1\r\n" +
                             "property float x\r\nproperty double y\r\nproperty short z\r\n" +
                             colors + faces + "end_header\r\n" + std::string(30, '\1'));
}

template<class Sample>
void addPictures(Seeds& seeds, std::initializer_list<const char*> formats,
                 const Pixels<Sample>& pixels)
{
    for (const char* format : formats) seeds.add("image", pictureFile(format, pixels));
}

void addImages(Seeds& seeds)
{
    addPictures(seeds, {"png", "jpeg", "webp", "tiff", "bmp", "targa"}, fourColors());
    addPictures(seeds, {"png", "tiff"},
                Pixels<uint16_t>{2, 2, 4, std::vector<uint16_t>(16, 30000)});
    addPictures(seeds, {"openexr", "hdr", "tiff"},
                Pixels<float>{8, 8, 3, std::vector<float>(192, 0.5f)});
    seeds.add("image", palettePng());
}

/// A closed room with a lamp in its ceiling, as a GLB whose texture shows the light.
std::string litRoom()
{
    const Scan room = scenes::room({2, 2, 2}, 4, [](glm::vec3 place, glm::vec3 normal) {
        const bool isLamp = normal.y < -0.5f && glm::distance(place, {1, 2, 1}) < 0.5f;
        return isLamp ? glm::vec3(1.0f) : glm::vec3(0.2f + 0.1f * place.y, 0.3f, 0.3f);
    });
    const SrgbFromHalf byteFrom;
    std::vector<uint8_t> bytes;
    for (const uint16_t half : room.pages[0].image.half()) bytes.push_back(byteFrom(half));
    const Size size{room.pages[0].image.width, room.pages[0].image.height};
    return writeUnlitGlb(room, {{.albedo = {encodePng(bytes, size, 3), "image/png"}}});
}

/// The same room, and what delight and relight leave of it.
void addResult(Seeds& seeds)
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("fuzz.glb", litRoom());
    Progress progress;
    DelightOptions options{.gather = {.quality = Quality::draft, .rays = 4, .shadowRays = 1}};
    options.gather.lights = {{1, 2, 1}};
    options.engine.engine = Engine::cpu;
    writeResult(delight(readScan(file, {}, progress), options, progress), file, folder / "out",
                progress);
    const DelitRoom room = readDelitRoom(folder / "out", {}, progress);
    const RelightOptions again{
        .rays = 4, .transport = room.transport, .engine = {.engine = Engine::cpu}};
    const Relighter relighter(room, again, progress);
    fuzz::ResultFiles files;
    for (size_t i = 0; i < fuzz::kFilesOfResult.size(); ++i) {
        const auto bytes = readFile(folder / fuzz::kFilesOfResult[i]);
        files[static_cast<uint8_t>(i)] = {reinterpret_cast<const char*>(bytes.data()),
                                          bytes.size()};
    }
    seeds.add("result", fuzz::joined(files));
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: relamp_fuzz_seeds FOLDER\n";
        return 2;
    }
    Seeds seeds(argv[1]);
    addGltf(seeds);
    addPly(seeds);
    addImages(seeds);
    addResult(seeds);
    const std::string obj =
        "mtllib fuzz.mtl\no wall\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0\nvn 0 0 1\n"
        "usemtl paint\nf 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\nf 1//1 2//1 3//1\n";
    const std::string mtl = "newmtl paint\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on a b.png\n";
    seeds.add("obj", obj + '\0' + mtl);
    seeds.add("obj", obj);
    seeds.add(
        "obj",
        "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
        "usemtl paint\nf 1/1 2/2 3/3\nf 3/3 2/2 4/4\n" +
            std::string("\0newmtl paint\nmap_Kd b.png\n", 27));
    seeds.add("lights_json",
              std::string(R"({"format": "relamp lights 1", "units": "", "fixtures": [{"id": 0,
        "centre": [0, 1, 2], "normal": [0, -1, 0], "area": 1, "radiance": [1, 2, 3], "power": [1, 2, 3], "on": true}],
        "lights": [{"type": "point", "position": [0, 1, 2], "normal": "omni", "intensity": [1, 2, 3], "radius": 0.1,
        "fixture": 0}], "ambient": [0.1, 0.1, 0.1]})"));
    seeds.add("timeline_json",
              std::string(R"({"format": "relamp timeline 1", "seconds": 2, "keys": [
        {"time": 1, "light": {"fixtures": [{"id": 0, "dim": 0.5, "kelvin": 2700}], "lights": [{"type": "sphere",
        "position": [0, 1, 2], "radius": 0.1, "lumens": 800, "kelvin": 3000}], "sky": {"radiance": [1, 1, 1]}}},
        {"time": 3, "light": {"fixtures": [{"id": 0, "on": false, "kelvin": 4000}], "lights": [{"type": "sphere",
        "position": [1, 1, 2], "radius": 0.2, "lumens": 0, "kelvin": 5000}], "sky": {"radiance": [0, 0, 1]}}}]})"));
    seeds.add("ies",
              std::string(
                  "IESNA:LM-63-2002\r\n[TEST] made up\r\nTILT=INCLUDE\r\n1\r\n2\r\n0 90\r\n1 1\r\n"
                  "1 1000 1.0 3 2 1 2 0.1 0.1 0\r\n1.0 1.0 12\r\n0 45 90\r\n0,90\r\n100 80 0 90 "
                  "7e1 0\r\n"));
    return 0;
}
