#pragma once

#include "relamp/scan.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relamp
{

// What relamp works on, whatever the format; docs/guide/scans.md lists these and why.
inline constexpr size_t kMostTriangles = size_t{1} << 26;
inline constexpr size_t kMostVertices = size_t{1} << 28; // read; meshes may share them
inline constexpr size_t kMostMeshes = size_t{1} << 16;   // one a primitive and node
inline constexpr size_t kMostPages = size_t{1} << 12;
inline constexpr size_t kMostItems = size_t{1} << 18; // of one list of a glTF
inline constexpr size_t kMostWarnings = 50;

/// What a file of `bytes` may come to, where one part of it may be used over and over: `most`, and
/// less where the file is small. Without, a few kilobytes could stand for more than any machine
/// holds.
constexpr size_t mostOfFile(size_t most, uint64_t bytes)
{
    constexpr uint64_t kAnyFileMayHave = uint64_t{1} << 21;
    constexpr uint64_t kAByteMayStandFor = 8;
    const uint64_t may = kAnyFileMayHave + kAByteMayStandFor * bytes;
    return may < most ? static_cast<size_t>(may) : most;
}

/// Counts the pixels of all pages of a scan, as they are read. Thread safe.
class PagePixels
{
public:
    /// `bytes`: of all pictures, as they are stored. Throws Error(malformed), naming `file`, where
    /// there are more pages than relamp works on.
    PagePixels(size_t pages, uint64_t bytes, const std::string& file);

    /// All pages' so far. Throws Error(malformed) where these are more pixels than relamp works on,
    /// or far more than pictures of their bytes.
    uint64_t add(size_t pixels);

private:
    std::string file_;
    uint64_t most_;
    std::atomic<uint64_t> sum_ = 0;
};

/// Throws Error(malformed), naming `file`, where a scan has more triangles or meshes than relamp
/// works on.
void checkCounts(const Scan& scan, const std::string& file);

/// Leaves the first kMostWarnings and says how many went.
void shortenWarnings(std::vector<std::string>& warnings);

} // namespace relamp
