#include "malformed/small_scans.h"

#include "scenes/gltf_files.h"
#include "scenes/pictures.h"

#include <cstring>
#include <random>

namespace relamp::malformed
{
namespace
{

std::string plyHeader(const std::string& format)
{
    return "ply\nformat " + format +
           " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\n"
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

template<class Number>
void append(std::string& bytes, Number number)
{
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}

} // namespace

SmallScan smallGlb()
{
    return {"room.glb", scenes::texturedSquare().glb(), {}};
}

SmallScan smallObj()
{
    const std::string obj = "mtllib room.mtl\no wall\n"
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                            "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvn 0 0 1\n"
                            "usemtl paint\nf 1/1/1 2/2/1 3/3/1\nf 3/3/1 2/2/1 4/4/1\n";
    return {"room.obj",
            obj,
            {{"room.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd -clamp on room.jpg\n"},
             {"room.jpg", smallPicture("jpeg")}}};
}

SmallScan smallTextPly()
{
    return {"room.ply",
            plyHeader("ascii") + "0 0 0 1 2 3\n1 0 0 255 255 255\n0 1 0 7 8 9\n1 1 0 99 99 99\n"
                                 "3 0 1 2\n3 2 1 3\n",
            {}};
}

SmallScan smallTexturedPly(const std::string& format)
{
    return {"room.ply",
            "ply\nformat ascii 1.0\ncomment TextureFile room." + format +
                "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "property float s\nproperty float t\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
            {{"room." + format, smallPicture(format)}}};
}

SmallScan smallBinaryPly()
{
    std::string bytes = plyHeader("binary_little_endian");
    for (const glm::vec3& p : scenes::squarePositions()) {
        for (const float v : {p.x, p.y, p.z}) append(bytes, v);
        bytes += "rgb";
    }
    for (const auto& face : {glm::ivec3(0, 1, 2), glm::ivec3(2, 1, 3)}) {
        bytes += '\3';
        for (const int index : {face.x, face.y, face.z}) append(bytes, int32_t{index});
    }
    return {"room.ply", bytes, {}};
}

std::string smallPicture(const std::string& format)
{
    scenes::Pixels<uint8_t> pixels{16, 16, 3, {}};
    for (int i = 0; i < 3 * 16 * 16; ++i) pixels.samples.push_back(static_cast<uint8_t>(i * i / 7));
    const auto file = scenes::pictureFile(format, pixels);
    return {file.begin(), file.end()};
}

std::string flipped(std::string bytes, size_t bit)
{
    bytes[bit / 8] =
        static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (1u << bit % 8));
    return bytes;
}

std::vector<size_t> scattered(size_t count, size_t end)
{
    std::vector<size_t> numbers;
    if (count >= end)
        for (size_t i = 0; i < end; ++i) numbers.push_back(i);
    std::mt19937 random(7); // NOLINT(cert-msc51-cpp): the same every time
    while (numbers.size() < count && count < end) numbers.push_back(random() % end);
    return numbers;
}

} // namespace relamp::malformed
