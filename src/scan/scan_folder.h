#pragma once

#include "relamp/scan.h"

#include <filesystem>
#include <string>

namespace relamp
{

/// Where the files that a scan names may lie: in its own folder and those below.
///
/// A scan is often a stranger's, and what it names goes into the result, which is passed on: a
/// texture "../../id_rsa" would carry that off.
class ScanFolder
{
public:
    ScanFolder(const std::filesystem::path& scanFile, const ScanOptions& options);

    /// The path of `named` as seen from the folder. Says nothing of whether it may be read.
    [[nodiscard]] std::filesystem::path operator/(const std::string& named) const
    {
        return folder_ / named;
    }

    /// Whether `file` may be read: with every link followed it lies inside, or is the scan itself;
    /// or ScanOptions::allowOutside is set.
    [[nodiscard]] bool holds(const std::filesystem::path& file) const;

    /// Error(unsupported): `who`, as "room.glb: image 0", names a file that lies outside.
    [[noreturn]] static void refuse(const std::string& who, const std::string& named);

private:
    std::filesystem::path folder_;
    std::filesystem::path real_;     // without links
    std::filesystem::path realScan_; // the same of the scan itself, wherever it lies
    bool allowOutside_;
};

} // namespace relamp
