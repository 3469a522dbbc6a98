#include "image/exr_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace relamp
{
namespace
{

constexpr size_t kLongestName = 255;
constexpr uint32_t kIsMultiPart = 0x1000; // of the version

/// Takes the front off some bytes; everything is empty or zero once they have run out.
class Taker
{
public:
    explicit Taker(std::span<const std::byte> bytes) : left_(bytes) {}

    [[nodiscard]] bool hasFailed() const { return hasFailed_; }
    [[nodiscard]] bool isEmpty() const { return left_.empty(); }

    std::span<const std::byte> bytes(size_t count)
    {
        hasFailed_ = hasFailed_ || count > left_.size();
        if (hasFailed_) return {};
        const auto taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }

    template<class Number>
    Number number() // little-endian, as this machine is
    {
        Number value{};
        const auto taken = bytes(sizeof value);
        if (!taken.empty()) std::memcpy(&value, taken.data(), sizeof value);
        return value;
    }

    /// Up to a zero, which is taken, too.
    std::string_view name()
    {
        const auto reach = left_.first(std::min(left_.size(), kLongestName + 1));
        const auto zero = std::find(reach.begin(), reach.end(), std::byte{0});
        hasFailed_ = hasFailed_ || zero == reach.end();
        if (hasFailed_) return {};
        const auto taken = bytes(static_cast<size_t>(zero - reach.begin()) + 1);
        return {reinterpret_cast<const char*>(taken.data()), taken.size() - 1};
    }

private:
    std::span<const std::byte> left_;
    bool hasFailed_ = false;
};

struct TypeSize
{
    std::string_view type;
    size_t bytes;
};

constexpr std::array kSizes = std::to_array<TypeSize>({
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
});

/// One part's.
struct Header
{
    double bytesPerPixel = 0;
    double width = 0;
    double height = 0;
    double tileWidth = 0; // 0: in lines
    double tileHeight = 0;
    double namedChunks = 0;
};

bool takeChannels(Taker content, Header& header)
{
    header.bytesPerPixel = 0;
    while (!content.name().empty()) {
        constexpr int32_t kHalf = 1;
        header.bytesPerPixel += content.number<int32_t>() == kHalf ? 2 : 4;
        content.bytes(4); // whether it is linear, and nothing
        if (content.number<int32_t>() < 1 || content.number<int32_t>() < 1) return false;
    }
    return !content.hasFailed() && content.isEmpty();
}

bool takeWindow(Taker content, Header& header)
{
    const double left = content.number<int32_t>();
    const double top = content.number<int32_t>();
    header.width = content.number<int32_t>() - left + 1;
    header.height = content.number<int32_t>() - top + 1;
    return header.width > 0 && header.height > 0;
}

bool takeTiles(Taker content, Header& header)
{
    header.tileWidth = content.number<uint32_t>();
    header.tileHeight = content.number<uint32_t>();
    return header.tileWidth > 0 && header.tileHeight > 0;
}

bool areTexts(Taker content)
{
    while (!content.isEmpty() && !content.hasFailed()) content.bytes(content.number<uint32_t>());
    return !content.hasFailed();
}

bool isPreview(std::span<const std::byte> bytes)
{
    Taker content(bytes);
    const auto width = int64_t{content.number<uint32_t>()};
    const auto height = int64_t{content.number<uint32_t>()};
    const auto pixels = static_cast<int64_t>(bytes.size()) / 4 - 2;
    return !content.hasFailed() && width <= pixels && height <= pixels && width * height == pixels;
}

/// What OpenEXR reads to its own end must end where the header says.
bool takeAttribute(std::string_view name, std::string_view type, std::span<const std::byte> bytes,
                   Header& header)
{
    const auto* known = std::find_if(kSizes.begin(), kSizes.end(),
                                     [&](const TypeSize& size) { return size.type == type; });
    if (known != kSizes.end() && known->bytes != bytes.size()) return false;
    if (type == "chlist") return takeChannels(Taker(bytes), header);
    if (type == "stringvector") return areTexts(Taker(bytes));
    if (type == "preview") return isPreview(bytes);
    if (type == "tiledesc") return takeTiles(Taker(bytes), header);
    if (type == "box2i" && name == "dataWindow") return takeWindow(Taker(bytes), header);
    if (type == "int" && name == "chunkCount") header.namedChunks = Taker(bytes).number<int32_t>();
    return true;
}

void addClaim(const Header& header, ExrHeaders& headers)
{
    const double pixels =
        std::max(header.width * header.height, header.tileWidth * header.tileHeight);
    headers.unpacked = std::max(headers.unpacked, header.bytesPerPixel * pixels);
    headers.chunks = std::max(headers.chunks, header.namedChunks);
    if (header.tileWidth > 0)
        headers.chunks = std::max(headers.chunks, std::ceil(header.width / header.tileWidth) *
                                                      std::ceil(header.height / header.tileHeight));
}

/// Attributes up to an empty name: a name and a type, a length and as many bytes.
bool takeHeader(Taker& file, std::string_view name, Header& header)
{
    for (; !name.empty(); name = file.name()) {
        const std::string_view type = file.name();
        const auto content = file.bytes(file.number<uint32_t>());
        if (file.hasFailed() || !takeAttribute(name, type, content, header)) return false;
    }
    return !file.hasFailed();
}

} // namespace

// Magic number and version, then a header; of a file of several parts more, and an empty one.
ExrHeaders readExrHeaders(std::span<const std::byte> bytes)
{
    ExrHeaders headers;
    Taker file(bytes);
    file.number<uint32_t>();
    const bool isMultiPart = (file.number<uint32_t>() & kIsMultiPart) != 0;
    std::string_view name = file.name();
    do {
        Header header;
        if (!takeHeader(file, name, header)) return headers;
        addClaim(header, headers);
        if (isMultiPart) name = file.name();
    } while (isMultiPart && !name.empty());
    headers.isSound = !file.hasFailed();
    return headers;
}

} // namespace relamp
