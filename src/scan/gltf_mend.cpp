#include "scan/gltf_mend.h"

#include "relamp/error.h"
#include "scan/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace relamp
{
namespace
{

constexpr double kLeastLength = 1e-6;

/// Accessors that primitives of the model use for `attribute`.
std::set<int> accessorsOf(const tinygltf::Model& model, const char* attribute)
{
    std::set<int> accessors;
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            if (const auto found = primitive.attributes.find(attribute);
                found != primitive.attributes.end())
                accessors.insert(found->second);
    return accessors;
}

void makeFinite(std::span<float> values)
{
    for (float& value : values)
        if (!std::isfinite(value)) value = 0.0f;
}

void makeUnit(std::span<float> normal)
{
    double length = 0.0;
    for (const float n : normal) length = std::hypot(length, static_cast<double>(n));
    for (size_t c = 0; c < normal.size(); ++c) // of no length: up is as good as any
        normal[c] = length < kLeastLength
                        ? (c == 1 ? 1.0f : 0.0f)
                        : static_cast<float>(static_cast<double>(normal[c]) / length);
}

} // namespace

void mendAccessors(tinygltf::Model& model, nlohmann::json& document)
{
    const std::set<int> positions = accessorsOf(model, "POSITION");
    const std::set<int> normals = accessorsOf(model, "NORMAL");
    for (int i = 0; i < static_cast<int>(model.accessors.size()); ++i) try {
            editFloats(model, i, "accessor", makeFinite);
            if (normals.contains(i)) editFloats(model, i, "accessor", makeUnit);
            nlohmann::json& accessor = document["accessors"][static_cast<size_t>(i)];
            if (!positions.contains(i) && !accessor.contains("min") && !accessor.contains("max"))
                continue;
            const AccessorBounds bounds = boundsOf(model, i, "accessor");
            accessor["min"] = bounds.low;
            accessor["max"] = bounds.high;
        } catch (const Error&) {
            // Broken, but the scan was read without it: it is left as it came.
        }
}

} // namespace relamp
