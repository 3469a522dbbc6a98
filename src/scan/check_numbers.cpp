#include "scan/check_numbers.h"

#include "base/fail.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relamp
{
namespace
{

constexpr float kFarthest = 1e5f;        // metres; there the floats lie 8 mm apart, as texels do
constexpr float kMostPictures = 1000.0f; // there they lie a pixel of a picture of 16384 apart
constexpr float kLongestNormal = 1e18f;  // the square of a longer one is no float
constexpr float kBrightest = 65504.0f;   // the largest half float, as which light is kept
constexpr float kRounding = 1e-3f;       // below zero by as much, a colour was black once

template<class Vector>
bool isWithin(const Vector& v, float low, float high)
{
    for (int c = 0; c < v.length(); ++c)
        if (!(v[c] >= low && v[c] <= high)) return false; // nor is NaN
    return true;
}

bool isPlace(const glm::vec3& position)
{
    return isWithin(position, -kFarthest, kFarthest);
}

bool isOnPicture(const glm::vec2& uv)
{
    return isWithin(uv, -kMostPictures, kMostPictures);
}

bool isDirection(const glm::vec3& normal)
{
    return isWithin(normal, -kLongestNormal, kLongestNormal);
}

bool isColor(const glm::vec3& color)
{
    return isWithin(color, -kRounding, kBrightest);
}

class NumberCheck
{
public:
    NumberCheck(const Mesh& mesh, const std::string& file)
        : used_(mesh.positions.size()), what_(fmt::format("{}: mesh \"{}\"", file, mesh.name)),
          wayOut_(fmt::format("or leave it out with --skip-mesh \"{}\"", mesh.name))
    {
        for (const glm::uvec3& t : mesh.triangles)
            for (int c = 0; c < 3; ++c) used_[t[c]] = 1;
    }

    /// `values` are one a vertex; `are` goes on from "3 of its 8 vertices".
    template<class Vector>
    void operator()(std::vector<Vector>& values, bool (*isGood)(const Vector&), const char* are,
                    const char* remedy) const
    {
        size_t bad = 0;
        for (size_t i = 0; i < values.size(); ++i) {
            if (isGood(values[i])) continue;
            if (used_[i] != 0) ++bad;
            values[i] = Vector(0.0f); // that no triangle uses: no NaN may be found by accident
        }
        if (bad == 0) return;
        const auto all = std::count(used_.begin(), used_.end(), 1);
        malformed(what_, fmt::format("{} of its {} vertices {}.\n{}, {}.", bad, all, are, remedy,
                                     wayOut_));
    }

    void checkFactor(const glm::vec3& factor) const
    {
        if (!isColor(factor))
            malformed(what_, fmt::format("the colour of its material is not from 0 to 65504, the "
                                         "largest half float.\nCorrect it, {}.",
                                         wayOut_));
    }

private:
    std::vector<uint8_t> used_; // by vertex: whether a triangle does
    std::string what_;
    std::string wayOut_;
};

glm::vec3 notBelowBlack(const glm::vec3& color)
{
    return glm::max(color, glm::vec3(0.0f));
}

} // namespace

void checkNumbers(Mesh& mesh, std::vector<glm::vec3>& vertexNormals, const std::string& file)
{
    const NumberCheck check(mesh, file);
    check(mesh.positions, isPlace,
          "lie at no place: a coordinate is not a finite number, or beyond 100 km, where a float "
          "no longer tells a centimetre from the next",
          "Export it again near its origin, say --scale if its unit is not the metre");
    check(mesh.uvs, isOnPicture,
          "have texture coordinates that are not finite numbers, or beyond 1000 pictures, where a "
          "float no longer tells a pixel from the next",
          "Unwrap it again");
    check(vertexNormals, isDirection,
          "have normals that are not finite numbers, or longer than 1e18, whose square is no float",
          "Export it again, without normals if need be");
    check(mesh.colors, isColor,
          "have colours that are no light: not from 0 to 65504, the largest half float",
          "Export it again");
    check.checkFactor(mesh.factor);
    std::transform(mesh.colors.begin(), mesh.colors.end(), mesh.colors.begin(), notBelowBlack);
    mesh.factor = notBelowBlack(mesh.factor);
}

} // namespace relamp
