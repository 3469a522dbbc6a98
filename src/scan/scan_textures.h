#pragma once

#include "relamp/scan.h"
#include "scan/scan_folder.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace relamp
{

/// Gathers the pictures that the meshes of an OBJ, PLY or the like name, and reads them as pages.
class ScanTextures
{
public:
    ScanTextures(const std::filesystem::path& scanFile, const ScanOptions& options)
        : scanFile_(scanFile), folder_(scanFile, options), transfer_(options.transfer)
    {}

    /// Index of the page for a picture, which `namedBy` (say, material "wall") asks for.
    int pageOf(const std::string& name, const std::string& namedBy);

    /// Reads all of them, in the order in which they were first asked for. Pictures are looked for
    /// in `embedded` by name, then beside the scan's file. Throws Error, naming the picture and who
    /// asked for it.
    [[nodiscard]] std::vector<Page>
    read(const std::map<std::string, std::vector<std::byte>>& embedded, Progress& progress) const;

private:
    struct Wanted
    {
        std::string name;
        std::string namedBy;
    };
    [[nodiscard]] std::filesystem::path find(const Wanted& wanted) const;

    std::filesystem::path scanFile_;
    ScanFolder folder_;
    Transfer transfer_;
    std::vector<Wanted> wanted_;
    std::map<std::string, int> indexOf_; // of these, by name
};

} // namespace relamp
