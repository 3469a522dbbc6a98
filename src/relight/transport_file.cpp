#include "relight/transport_file.h"

#include "base/file.h"
#include "base/hash.h"
#include "relamp/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace relamp
{
namespace
{

static_assert(std::endian::native == std::endian::little, "transport.bin holds memory as it is");

constexpr uint64_t kMagic = 0x33'54'50'4d'41'4c'45'52; // "RELAMPT3": another version, another digit

/// Appends arrays, each with its length.
class Writer
{
public:
    void add(uint64_t word) { append(&word, sizeof word); }
    template<class T>
    void add(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        add(values.size());
        append(values.data(), values.size() * sizeof(T));
    }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    void append(const void* data, size_t size)
    {
        const auto* begin = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }

    std::vector<std::byte> bytes_;
};

/// Reads what Writer wrote; says no instead of reading beyond the end.
class Reader
{
public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

    bool take(uint64_t& word)
    {
        if (rest_.size() < sizeof word) return false;
        std::memcpy(&word, rest_.data(), sizeof word);
        rest_ = rest_.subspan(sizeof word);
        return true;
    }
    template<class T>
    bool take(std::vector<T>& values)
    {
        uint64_t count = 0;
        if (!take(count) || count > rest_.size() / sizeof(T)) return false;
        values.assign(count, T{});
        if (count > 0) std::memcpy(values.data(), rest_.data(), count * sizeof(T));
        rest_ = rest_.subspan(count * sizeof(T));
        return true;
    }
    [[nodiscard]] std::span<const std::byte> rest() const { return rest_; }

private:
    std::span<const std::byte> rest_;
};

uint64_t hashOf(std::span<const std::byte> bytes)
{
    Hash hash;
    hash.addBytes(bytes);
    return hash.value();
}

bool isSound(const SightLists& lists, size_t receivers, size_t radiances)
{
    if (lists.first.size() != receivers + 1 || lists.first.front() != 0 ||
        lists.first.back() != lists.target.size())
        return false;
    for (size_t list = 0; list < receivers; ++list)
        if (lists.first[list] >= lists.first[list + 1]) return false;
    return std::all_of(lists.target.begin(), lists.target.end(),
                       [&](uint32_t target) { return target < radiances; });
}

/// Whether every index points at something, and every number is one.
bool isSound(const Transport& transport, const Texels& texels)
{
    const size_t surfels = texels.surfels.count();
    const size_t sides = transport.sides.size();
    if (sides < surfels || transport.clusterOf.size() != sides ||
        transport.weight.size() != sides || transport.ofClusters.first.empty() ||
        !isSound(transport.ofFronts, surfels, sides + Transport::radiancesBeyond()) ||
        !isSound(transport.ofClusters, transport.clusters(),
                 transport.clusters() + Transport::radiancesBeyond()))
        return false;
    for (size_t i = 0; i < sides; ++i)
        if (transport.sides[i].surfel() >= surfels ||
            transport.clusterOf[i] >= transport.clusters() ||
            (i < surfels && transport.sides[i].index != 2 * i))
            return false;
    return std::all_of(transport.weight.begin(), transport.weight.end(),
                       [](float share) { return share >= 0.0f && share <= 1.001f; }); // as rounded
}

} // namespace

uint64_t keyOfTransport(const Texels& texels, size_t rays)
{
    Hash hash;
    for (const Mesh& mesh : texels.scan->meshes) {
        hash.add(mesh.positions);
        hash.add(mesh.uvs);
        hash.add(mesh.triangles);
    }
    for (const Page& page : texels.scan->pages) {
        std::visit([&](const auto& rgb) { hash.add(rgb); }, page.image.rgb);
    }
    hash.add(texels.surfels.key);
    hash.add(rays);
    return hash.value();
}

std::optional<Transport> loadTransport(const std::filesystem::path& file, uint64_t key,
                                       const Texels& texels)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return {};
    std::vector<std::byte> bytes;
    try {
        bytes = readFile(file);
    } catch (const Error&) {
        return {};
    }
    Reader reader(bytes);
    uint64_t magic = 0;
    uint64_t theirs = 0;
    uint64_t checksum = 0;
    if (!reader.take(magic) || magic != kMagic || !reader.take(theirs) || theirs != key ||
        !reader.take(checksum) || checksum != hashOf(reader.rest()))
        return {};
    Transport transport;
    std::vector<uint32_t> sides;
    if (!reader.take(sides) || !reader.take(transport.clusterOf) ||
        !reader.take(transport.weight) || !reader.take(transport.ofFronts.first) ||
        !reader.take(transport.ofFronts.target) || !reader.take(transport.ofClusters.first) ||
        !reader.take(transport.ofClusters.target))
        return {};
    for (const uint32_t side : sides) transport.sides.push_back({side});
    if (!reader.rest().empty() || !isSound(transport, texels)) return {};
    return transport;
}

void saveTransport(const std::filesystem::path& file, uint64_t key, const Transport& transport)
{
    Writer content;
    std::vector<uint32_t> sides;
    for (const Side side : transport.sides) sides.push_back(side.index);
    content.add(sides);
    content.add(transport.clusterOf);
    content.add(transport.weight);
    content.add(transport.ofFronts.first);
    content.add(transport.ofFronts.target);
    content.add(transport.ofClusters.first);
    content.add(transport.ofClusters.target);
    Writer whole;
    whole.add(kMagic);
    whole.add(key);
    whole.add(hashOf(content.bytes()));
    std::vector<std::byte> bytes = whole.bytes();
    bytes.insert(bytes.end(), content.bytes().begin(), content.bytes().end());
    replaceFile(file, bytes);
}

} // namespace relamp
