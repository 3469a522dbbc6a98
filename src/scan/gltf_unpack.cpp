#include "scan/gltf_unpack.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"
#include "scan/gltf_decode.h"
#include "scan/gltf_json.h"
#include "scan/gltf_shape.h"
#include "scan/gltf_uri.h"
#include "scan/scan_folder.h"
#include "scan/scan_limits.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr uint64_t kLargestBinary =
    (uint64_t{1} << 32) - (uint64_t{1} << 24); // a GLB ends at 4 GiB
// Draco packs the dullest of meshes some hundred times; a file that unpacks much further names one
// stream over and over.
constexpr uint64_t kMostExpansion = 256;
constexpr uint64_t kAnyFileMayUnpackTo = uint64_t{1} << 26;
constexpr std::array kSections{"buffers", "bufferViews", "accessors", "images",  "meshes",
                               "nodes",   "scenes",      "materials", "textures"};

/// A whole number of a document that checkShape has passed; 0 where there is none.
uint64_t wholeAt(const json& object, const char* key)
{
    return object.value(key, uint64_t{0});
}

bool hasExtension(const json& object, const char* name)
{
    const auto extensions = object.find("extensions");
    return extensions != object.end() && extensions->contains(name);
}

/// Each item takes some hundred bytes of text, and some thousand of memory.
void checkLists(const json& document, const std::string& file)
{
    size_t primitives = 0;
    const auto check = [&](const std::string& key, size_t count) {
        if (count > kMostItems)
            malformed(file, fmt::format("has {} {}, and relamp works on {} at most; simplify it",
                                        count, key, kMostItems));
    };
    for (const auto& [key, list] : document.items()) {
        if (!list.is_array()) continue;
        check(key, list.size());
        if (key != "meshes") continue;
        for (const json& mesh : list) {
            const auto found = mesh.is_object() ? mesh.find("primitives") : mesh.end();
            if (found != mesh.end() && found->is_array()) primitives += found->size();
        }
        check("primitives", primitives);
    }
}

/// Rewrites a document step by step; the binary chunk grows as things are pulled into it.
class Unpacker
{
public:
    /// `size` is that of the file, in bytes.
    Unpacker(json& document, std::span<const std::byte> chunk, size_t size,
             const std::filesystem::path& file, const ScanOptions& options)
        : document_(document), chunk_(chunk), bytesRead_(size), folder_(file, options),
          name_(file.string())
    {}

    void run();

    std::vector<uint8_t> binary;
    std::vector<std::string> warnings;

private:
    void checkScene() const;
    json& section(const char* key) { return document_[key]; }
    void checkPlace(const std::string& uri, const std::string& what) const;
    std::vector<uint8_t> fetch(const std::string& uri, const std::string& what);
    void takeBuffers();
    void rebaseView(size_t index);
    void decodeMeshoptView(size_t index);
    void takeImage(size_t index);
    void decodeMesh(size_t index);
    void decodeDracoPrimitive(json& primitive, const std::string& what);
    uint64_t append(std::span<const uint8_t> bytes);
    size_t appendView(std::span<const uint8_t> bytes, size_t byteStride = 0);
    std::span<const uint8_t> bytesOfView(size_t view, const std::string& what);
    void setAccessor(const json& index, size_t view, uint64_t count, int componentType,
                     const std::string& what);
    void dropExtension(const char* name);

    json& document_;
    std::span<const std::byte> chunk_;
    uint64_t bytesRead_;
    ScanFolder folder_;
    std::string name_;
    std::vector<std::pair<uint64_t, uint64_t>> bufferRange_; // offset and size in `binary`
};

void Unpacker::checkScene() const
{
    const auto scenes = document_.find("scenes");
    const uint64_t scene = wholeAt(document_, "scene");
    if (scenes != document_.end() && !scenes->empty() && scene >= scenes->size())
        malformed(name_, fmt::format("refers to scene {}, which is not there", scene));
}

void Unpacker::checkPlace(const std::string& uri, const std::string& what) const
{
    if (!isDataUri(uri) && !folder_.holds(folder_ / decodePercent(uri)))
        ScanFolder::refuse(what, uri);
}

std::vector<uint8_t> Unpacker::fetch(const std::string& uri, const std::string& what)
{
    if (isDataUri(uri)) return decodeDataUri(uri, what);
    checkPlace(uri, what);
    try {
        const auto bytes = readFile(folder_ / decodePercent(uri));
        bytesRead_ += bytes.size();
        const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
        return {begin, begin + bytes.size()};
    } catch (const Error& error) {
        throw Error(error.code(),
                    fmt::format("{} needs another file, which should lie beside it: {}", what,
                                error.what()));
    }
}

uint64_t Unpacker::append(std::span<const uint8_t> bytes)
{
    const uint64_t offset = (binary.size() + 15) / 16 * 16;
    if (offset + bytes.size() >
        std::min(kLargestBinary, kAnyFileMayUnpackTo + kMostExpansion * bytesRead_))
        malformed(name_, "unpacks to far more than a file of its size can hold");
    binary.resize(offset);
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return offset;
}

size_t Unpacker::appendView(std::span<const uint8_t> bytes, size_t byteStride)
{
    json& views = section("bufferViews");
    const uint64_t offset = append(bytes);
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    if (byteStride != 0) views.back()["byteStride"] = byteStride;
    return views.size() - 1;
}

void Unpacker::takeBuffers()
{
    for (const json& buffer : section("buffers")) {
        const size_t index = bufferRange_.size();
        const std::string what = fmt::format("{}: buffer {}", name_, index);
        const uint64_t announced = wholeAt(buffer, "byteLength");
        std::vector<uint8_t> bytes;
        if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
            bytes = fetch(uri->get<std::string>(), what);
        } else if (index == 0 && !chunk_.empty()) {
            const auto* begin = reinterpret_cast<const uint8_t*>(chunk_.data());
            bytes.assign(begin, begin + chunk_.size());
        } // else a meshopt fallback: announced, never stored
        const uint64_t size = std::min<uint64_t>(announced, bytes.size());
        bytes.resize(size);
        bufferRange_.emplace_back(append(bytes), size);
    }
}

void Unpacker::rebaseView(size_t index)
{
    json& view = section("bufferViews")[index];
    const std::string what = fmt::format("{}: bufferView {}", name_, index);
    const uint64_t buffer = wholeAt(view, "buffer");
    const uint64_t offset = wholeAt(view, "byteOffset");
    const uint64_t length = wholeAt(view, "byteLength");
    if (buffer >= bufferRange_.size())
        malformed(what, fmt::format("refers to buffer {}, and there are {}", buffer,
                                    bufferRange_.size()));
    const auto [begin, size] = bufferRange_[buffer];
    if (length == 0 || offset > size || length > size - offset)
        malformed(what,
                  fmt::format("wants bytes {} to {} of a buffer of {}; the file is cut off or "
                              "damaged",
                              offset, offset + length, size));
    view["buffer"] = 0;
    view["byteOffset"] = begin + offset;
}

void Unpacker::decodeMeshoptView(size_t index)
{
    const std::string what = fmt::format("{}: bufferView {}", name_, index);
    const json view = section("bufferViews")[index];
    const json& compressed = view["extensions"]["EXT_meshopt_compression"];
    const uint64_t buffer = wholeAt(compressed, "buffer");
    const uint64_t offset = wholeAt(compressed, "byteOffset");
    const uint64_t length = wholeAt(compressed, "byteLength");
    if (buffer >= bufferRange_.size() || offset > bufferRange_[buffer].second ||
        length > bufferRange_[buffer].second - offset)
        malformed(what, "its EXT_meshopt_compression lies outside its buffer");
    const MeshoptStream stream{
        .bytes = std::span(binary).subspan(bufferRange_[buffer].first + offset, length),
        .count = wholeAt(compressed, "count"),
        .stride = wholeAt(compressed, "byteStride"),
        .mode = compressed.value("mode", ""),
        .filter = compressed.value("filter", "NONE"),
    };
    const std::vector<uint8_t> decoded = decodeMeshopt(stream, what);
    json& target = section("bufferViews")[index];
    target["extensions"].erase("EXT_meshopt_compression");
    if (target["extensions"].empty()) target.erase("extensions");
    target["buffer"] = 0;
    target["byteOffset"] = append(decoded);
    target["byteLength"] = decoded.size();
}

void Unpacker::takeImage(size_t index)
{
    json& image = section("images")[index];
    const auto uri = image.find("uri");
    if (uri == image.end()) return;
    const std::string what = fmt::format("{}: image {}", name_, index);
    checkPlace(uri->get<std::string>(), what);
    std::vector<uint8_t> bytes;
    try {
        bytes = fetch(uri->get<std::string>(), what);
    } catch (const Error& error) {
        // Only the base colour matters here; what needs this picture complains, naming it.
        warnings.emplace_back(error.what());
        return;
    }
    if (bytes.empty()) malformed(what, "is empty");
    const size_t view = appendView(bytes);
    json& target = section("images")[index];
    target.erase("uri");
    target["bufferView"] = view;
    target["mimeType"] = mimeTypeOf(bytes);
}

std::span<const uint8_t> Unpacker::bytesOfView(size_t view, const std::string& what)
{
    const json& views = section("bufferViews");
    if (view >= views.size())
        malformed(what, fmt::format("refers to bufferView {}, which is not there", view));
    return std::span(binary).subspan(wholeAt(views[view], "byteOffset"),
                                     wholeAt(views[view], "byteLength"));
}

void Unpacker::setAccessor(const json& index, size_t view, uint64_t count, int componentType,
                           const std::string& what)
{
    json& accessors = section("accessors");
    if (!index.is_number_unsigned() || index.get<uint64_t>() >= accessors.size())
        malformed(what, "refers to an accessor that is not there");
    json& accessor = accessors[index.get<size_t>()];
    accessor["bufferView"] = view;
    accessor["count"] = count;
    accessor["componentType"] = componentType;
    accessor.erase("byteOffset");
    accessor.erase("sparse");
}

void Unpacker::decodeDracoPrimitive(json& primitive, const std::string& what)
{
    const json compressed = primitive["extensions"]["KHR_draco_mesh_compression"];
    const uint64_t view = wholeAt(compressed, "bufferView");
    const DracoMesh mesh(bytesOfView(view, what), what);

    if (!primitive.contains("indices")) {
        section("accessors").push_back({{"type", "SCALAR"}});
        primitive["indices"] = section("accessors").size() - 1;
    }
    const auto indices = mesh.indices();
    setAccessor(primitive["indices"], appendView(indices), indices.size() / sizeof(uint32_t),
                TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, what);
    primitive["mode"] = TINYGLTF_MODE_TRIANGLES;

    for (const auto& [name, id] : compressed["attributes"].items()) {
        const json target = primitive["attributes"].value(name, json());
        if (!id.is_number_unsigned() || target.is_null()) continue;
        json& accessors = section("accessors");
        if (!target.is_number_unsigned() || target.get<uint64_t>() >= accessors.size())
            malformed(what, "refers to an accessor that is not there");
        const json& accessor = accessors[target.get<size_t>()];
        const auto type = static_cast<int>(wholeAt(accessor, "componentType"));
        const size_t components = componentsOf(accessor.value("type", ""));
        const auto values = mesh.attribute(id.get<uint32_t>(), type, components, what);
        const size_t stride = mesh.points() == 0 ? 0 : values.size() / mesh.points();
        setAccessor(target, appendView(values, stride), mesh.points(), type, what);
    }
    primitive["extensions"].erase("KHR_draco_mesh_compression");
    if (primitive["extensions"].empty()) primitive.erase("extensions");
}

void Unpacker::decodeMesh(size_t index)
{
    json& mesh = section("meshes")[index];
    const std::string what =
        fmt::format("{}: mesh {} \"{}\"", name_, index, mesh.value("name", ""));
    for (json& primitive : mesh["primitives"])
        if (hasExtension(primitive, "KHR_draco_mesh_compression"))
            decodeDracoPrimitive(primitive, what);
}

void Unpacker::dropExtension(const char* name)
{
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const auto found = document_.find(key);
        if (found == document_.end()) continue;
        found->erase(std::remove(found->begin(), found->end(), json(name)), found->end());
        if (found->empty()) document_.erase(found);
    }
}

void Unpacker::run()
{
    checkScene();
    for (const char* key : kSections)
        if (!document_.contains(key)) document_[key] = json::array();
    takeBuffers();
    for (size_t i = 0, count = section("bufferViews").size(); i < count; ++i) {
        const bool meshopt = hasExtension(section("bufferViews")[i], "EXT_meshopt_compression");
        meshopt ? decodeMeshoptView(i) : rebaseView(i);
    }
    for (size_t i = 0, count = section("images").size(); i < count; ++i) takeImage(i);

    for (size_t i = 0, count = section("meshes").size(); i < count; ++i) decodeMesh(i);
    dropExtension("EXT_meshopt_compression");
    dropExtension("KHR_draco_mesh_compression");
    document_["buffers"] = json::array();
    if (!binary.empty()) document_["buffers"].push_back({{"byteLength", binary.size()}});
    for (const char* key : kSections)
        if (section(key).empty()) document_.erase(key);
}

} // namespace

PlainGltf unpackGltf(std::span<const std::byte> bytes, const std::filesystem::path& file,
                     const ScanOptions& options)
{
    const GltfChunks chunks = splitGltf(bytes, file.string());
    json document = parseJson(chunks.json, file.string());
    checkVersion(document, file.string());
    checkLists(document, file.string());
    checkShape(document, file.string());
    checkExtensions(document, file.string());
    Unpacker unpacker(document, chunks.binary, bytes.size(), file, options);
    unpacker.run();
    return {std::move(document), std::move(unpacker.binary), std::move(unpacker.warnings)};
}

} // namespace relamp
