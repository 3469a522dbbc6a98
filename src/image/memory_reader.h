#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include <OpenImageIO/filesystem.h>

namespace relamp
{

/// A file in memory, for OpenImageIO to read. Its own reader trusts the places that a file names:
/// a negative one makes it read what lies before the bytes. And it does not tell of a read that
/// went beyond the end: libtiff's are taken for black.
class MemoryReader : public OIIO::Filesystem::IOMemReader
{
public:
    explicit MemoryReader(std::span<const std::byte> bytes)
        : IOMemReader(bytes.data(), bytes.size())
    {}

    bool seek(int64_t offset) override
    {
        const bool isFound = isInside(offset) && OIIO::Filesystem::IOMemReader::seek(offset);
        shortReads_ += isFound ? 0 : 1;
        return isFound;
    }
    size_t read(void* to, size_t count) override
    {
        return noted(OIIO::Filesystem::IOMemReader::read(to, count), count);
    }
    size_t pread(void* to, size_t count, int64_t offset) override
    {
        if (!isInside(offset)) return noted(0, count);
        return noted(OIIO::Filesystem::IOMemReader::pread(to, count, offset), count);
    }

    /// How often more was asked for than there is.
    [[nodiscard]] int shortReads() const { return shortReads_; }

private:
    size_t noted(size_t read, size_t wanted)
    {
        shortReads_ += read < wanted ? 1 : 0;
        return read;
    }
    [[nodiscard]] bool isInside(int64_t offset) const
    {
        return offset >= 0 && offset <= static_cast<int64_t>(size());
    }

    std::atomic<int> shortReads_ = 0;
};

} // namespace relamp
