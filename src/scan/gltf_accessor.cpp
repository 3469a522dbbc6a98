#include "scan/gltf_accessor.h"

#include "base/fail.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace relamp
{
namespace
{

constexpr size_t kMostElements = size_t{1} << 28;
constexpr size_t kMostElementsWithoutStorage = size_t{1} << 16; // nothing in the file backs them

size_t sizeOfComponent(int type, const std::string& what)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        malformed(what, fmt::format("componentType {} is none of glTF's", type));
    }
}

/// Elements of `size` bytes, `stride` apart, in the model's one buffer.
struct Elements
{
    const uint8_t* first = nullptr;
    size_t stride = 0;

    [[nodiscard]] const uint8_t* operator[](size_t i) const { return first + i * stride; }
};

struct Layout
{
    int view;
    uint64_t offset;
    uint64_t count;
    size_t size;
};

Elements locate(const tinygltf::Model& model, const Layout& layout, const std::string& what)
{
    if (layout.view < 0 || static_cast<size_t>(layout.view) >= model.bufferViews.size())
        malformed(what, fmt::format("refers to bufferView {}, which is not there", layout.view));
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(layout.view)];
    const auto& bytes = model.buffers.at(0).data; // unpackGltf leaves one, and every view within it
    const size_t stride = view.byteStride != 0 ? view.byteStride : layout.size;
    if (layout.count == 0) return {bytes.data(), stride};
    const bool fits = layout.offset <= view.byteLength &&
                      layout.size <= view.byteLength - layout.offset &&
                      layout.count - 1 <= (view.byteLength - layout.offset - layout.size) / stride;
    if (!fits)
        malformed(what,
                  fmt::format("announces {} elements, more than its bufferView of {} bytes holds",
                              layout.count, view.byteLength));
    return {bytes.data() + view.byteOffset + layout.offset, stride};
}

template<class Component>
Component load(const uint8_t* bytes)
{
    Component value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

double componentAt(const uint8_t* bytes, int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return load<int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return load<int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<uint32_t>(bytes);
    default:
        return static_cast<double>(load<float>(bytes));
    }
}

/// What a whole number of `type` is divided by where it stands for a fraction.
double fullScaleOf(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::numeric_limits<int8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return std::numeric_limits<uint8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::numeric_limits<int16_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return std::numeric_limits<uint16_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return std::numeric_limits<uint32_t>::max();
    default:
        return 1.0;
    }
}

uint32_t componentAsIndex(const uint8_t* bytes, int type, const std::string& what)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<uint32_t>(bytes);
    default:
        malformed(what, "has indices that are not unsigned integers");
    }
}

const tinygltf::Accessor& accessorAt(const tinygltf::Model& model, int index,
                                     const std::string& what)
{
    if (index < 0 || static_cast<size_t>(index) >= model.accessors.size())
        malformed(what, fmt::format("refers to accessor {}, which is not there", index));
    return model.accessors[static_cast<size_t>(index)];
}

size_t sizeOfElement(const tinygltf::Accessor& accessor, const std::string& what)
{
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (components <= 0)
        malformed(what, fmt::format("its accessor type {} is none of glTF's", accessor.type));
    return static_cast<size_t>(components) * sizeOfComponent(accessor.componentType, what);
}

/// Calls `take(element index, bytes)` for every stored element: the dense ones, then the sparse.
template<class Take>
void forEachElement(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                    const std::string& what, const Take& take)
{
    const size_t size = sizeOfElement(accessor, what);
    if (accessor.bufferView >= 0) {
        const Elements dense =
            locate(model, {accessor.bufferView, accessor.byteOffset, accessor.count, size}, what);
        for (size_t i = 0; i < accessor.count; ++i) take(i, dense[i]);
    }
    if (!accessor.sparse.isSparse) return;
    const auto& [count, isSparse, at, values] = accessor.sparse;
    if (count < 0 || at.byteOffset < 0 || values.byteOffset < 0)
        malformed(what, "has a broken sparse part");
    const auto elements = static_cast<uint64_t>(count);
    const size_t indexSize = sizeOfComponent(at.componentType, what);
    const Elements indices = locate(
        model, {at.bufferView, static_cast<uint64_t>(at.byteOffset), elements, indexSize}, what);
    const Elements stored = locate(
        model, {values.bufferView, static_cast<uint64_t>(values.byteOffset), elements, size}, what);
    for (size_t i = 0; i < elements; ++i) {
        const uint32_t index = componentAsIndex(indices[i], at.componentType, what);
        if (index >= accessor.count) malformed(what, "has a sparse index out of range");
        take(index, stored[i]);
    }
}

/// To be called before making room for what an accessor announces.
void checkCount(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                const std::string& what)
{
    const size_t most = accessor.bufferView >= 0 ? kMostElements : kMostElementsWithoutStorage;
    if (accessor.count > most)
        malformed(what,
                  fmt::format("announces {} elements, more than relamp works on", accessor.count));
    if (accessor.bufferView >= 0)
        locate(model,
               {accessor.bufferView, accessor.byteOffset, accessor.count,
                sizeOfElement(accessor, what)},
               what);
}

} // namespace

AccessorFloats readFloats(const tinygltf::Model& model, int index, size_t leastComponents,
                          const std::string& what)
{
    const tinygltf::Accessor& accessor = accessorAt(model, index, what);
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (components < static_cast<int>(leastComponents) || components > 4)
        malformed(what, fmt::format("has {} components where {} are needed", components,
                                    leastComponents));
    checkCount(model, accessor, what);
    const size_t componentSize = sizeOfComponent(accessor.componentType, what);
    const double scale = accessor.normalized ? fullScaleOf(accessor.componentType) : 1.0;
    const double least = accessor.normalized ? -1.0 : std::numeric_limits<double>::lowest();

    AccessorFloats floats;
    floats.components = static_cast<size_t>(components);
    floats.values.resize(accessor.count * floats.components);
    forEachElement(model, accessor, what, [&](size_t element, const uint8_t* bytes) {
        float* target = &floats.values[element * floats.components];
        for (size_t c = 0; c < floats.components; ++c) {
            const double value =
                componentAt(bytes + c * componentSize, accessor.componentType) / scale;
            target[c] = static_cast<float>(value < least ? least : value); // NaN stays
        }
    });
    return floats;
}

std::vector<uint32_t> readIndices(const tinygltf::Model& model, int index, const std::string& what)
{
    const tinygltf::Accessor& accessor = accessorAt(model, index, what);
    if (accessor.type != TINYGLTF_TYPE_SCALAR) malformed(what, "has indices that are no scalars");
    checkCount(model, accessor, what);
    std::vector<uint32_t> indices(accessor.count);
    forEachElement(model, accessor, what, [&](size_t element, const uint8_t* bytes) {
        indices[element] = componentAsIndex(bytes, accessor.componentType, what);
    });
    return indices;
}

void editFloats(tinygltf::Model& model, int index, const std::string& what,
                const std::function<void(std::span<float>)>& edit)
{
    const tinygltf::Accessor& accessor = accessorAt(model, index, what);
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
    auto& bytes = model.buffers.at(0).data;
    std::vector<float> values(sizeOfElement(accessor, what) / sizeof(float));
    forEachElement(model, accessor, what, [&](size_t, const uint8_t* stored) {
        uint8_t* target = bytes.data() + (stored - bytes.data());
        std::memcpy(values.data(), target, values.size() * sizeof(float));
        edit(values);
        std::memcpy(target, values.data(), values.size() * sizeof(float));
    });
}

AccessorBounds boundsOf(const tinygltf::Model& model, int index, const std::string& what)
{
    const tinygltf::Accessor& accessor = accessorAt(model, index, what);
    checkCount(model, accessor, what);
    const size_t componentSize = sizeOfComponent(accessor.componentType, what);
    const size_t components = sizeOfElement(accessor, what) / componentSize;
    std::vector<double> values(accessor.count * components); // zero where nothing is stored
    forEachElement(model, accessor, what, [&](size_t element, const uint8_t* bytes) {
        for (size_t c = 0; c < components; ++c)
            values[element * components + c] =
                componentAt(bytes + c * componentSize, accessor.componentType);
    });
    if (values.empty()) malformed(what, "is empty");
    AccessorBounds bounds;
    bounds.low.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components));
    bounds.high = bounds.low;
    for (size_t i = 0; i < values.size(); ++i) {
        bounds.low[i % components] = std::min(bounds.low[i % components], values[i]);
        bounds.high[i % components] = std::max(bounds.high[i % components], values[i]);
    }
    return bounds;
}

} // namespace relamp
