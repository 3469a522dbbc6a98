#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relamp
{

enum class PlyEncoding { ascii, littleEndian, bigEndian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty
{
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> countType; // of a list
};

struct PlyElement
{
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader
{
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string>
        textureFiles; // of "comment TextureFile", as MeshLab and others write it
    size_t size = 0;  // bytes up to the body
};

/// Throws Error(malformed), naming `name` and the line.
PlyHeader parsePlyHeader(std::span<const std::byte> bytes, const std::string& name);

/// 255 for uint8 and so on; 1 for types that are no whole numbers.
double largestOf(PlyType type);

/// The numbers of a PLY's body, one after another.
class PlyBody
{
public:
    PlyBody(std::span<const std::byte> body, PlyEncoding encoding, const std::string& name);

    /// Throws Error(malformed) where the file ends too early or has something that is no number.
    double next(PlyType type);
    /// Reads a property into `values`: one number, or as many as the list says.
    void next(const PlyProperty& property, std::vector<double>& values);

    /// Throws Error(malformed) where the rest of the file cannot hold that many, before anyone
    /// makes room for them.
    void expect(const PlyElement& element) const;
    /// Throws Error(malformed) where the file goes on behind what the header announces.
    void expectEnd() const;

private:
    double nextWord();
    [[noreturn]] void endsTooEarly() const;

    std::string_view rest_;
    PlyEncoding encoding_;
    std::string name_;
};

} // namespace relamp
