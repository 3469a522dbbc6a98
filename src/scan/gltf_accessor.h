#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tinygltf
{
class Model;
}

namespace relamp
{

/// Numbers of an accessor: `components` each, tightly packed.
struct AccessorFloats
{
    size_t components;
    std::vector<float> values;

    [[nodiscard]] size_t count() const { return values.size() / components; }
};

/// Reads any vertex attribute: every component type, normalised or not, interleaved or sparse, or
/// without storage (zeros). `what` begins the sentence of the Error(malformed) that it throws where
/// the accessor reaches outside its buffer or is not of at least `leastComponents`.
AccessorFloats readFloats(const tinygltf::Model& model, int accessor, size_t leastComponents,
                          const std::string& what);

/// Reads vertex indices of 8, 16 or 32 bits.
std::vector<uint32_t> readIndices(const tinygltf::Model& model, int accessor,
                                  const std::string& what);

/// Shows `edit` every stored element of an accessor of floats, to be changed where it lies; leaves
/// accessors of whole numbers alone. Throws Error(malformed) as readFloats does.
void editFloats(tinygltf::Model& model, int accessor, const std::string& what,
                const std::function<void(std::span<float>)>& edit);

/// Least and largest number of each component, as they are stored.
struct AccessorBounds
{
    std::vector<double> low;
    std::vector<double> high;
};
/// Throws as readFloats does.
AccessorBounds boundsOf(const tinygltf::Model& model, int accessor, const std::string& what);

} // namespace relamp
