#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <OpenImageIO/filesystem.h>

namespace relamp
{

/// A file in memory, for OpenImageIO to read. Its own reader trusts the places that a file names:
/// a negative one makes it read what lies before the bytes.
class MemoryReader : public OIIO::Filesystem::IOMemReader
{
public:
    explicit MemoryReader(std::span<const std::byte> bytes)
        : IOMemReader(bytes.data(), bytes.size())
    {}

    bool seek(int64_t offset) override
    {
        return isInside(offset) && OIIO::Filesystem::IOMemReader::seek(offset);
    }
    size_t pread(void* to, size_t count, int64_t offset) override
    {
        return isInside(offset) ? OIIO::Filesystem::IOMemReader::pread(to, count, offset) : 0;
    }

private:
    [[nodiscard]] bool isInside(int64_t offset) const
    {
        return offset >= 0 && offset <= static_cast<int64_t>(size());
    }
};

} // namespace relamp
