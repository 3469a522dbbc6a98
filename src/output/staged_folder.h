#pragma once

#include "relamp/progress.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// A folder that gets its files when all of them are complete, or none.
///
/// Files are written into a hidden folder beside it and moved in by commit(). Without a commit, and
/// whatever is thrown, what was there before stays as it was; the hidden folder goes, and so do the
/// folders around it that were made for it.
class StagedFolder
{
public:
    /// Throws Error(cannotWrite) where `folder` or its neighbourhood cannot be written, or is a
    /// file.
    StagedFolder(const std::filesystem::path& folder, Progress& progress);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    /// Where to write the file that will be `name` in the folder.
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
    {
        return staging_ / name;
    }

    /// Moves all in: a folder that is not there yet appears in one step; into one that is, file by
    /// file, `last` as the last one, so that its presence says that the others are complete. Files
    /// of the folder named in `stale` and not written anew are removed.
    void commit(const std::string& last, const std::vector<std::string>& stale);

    /// Where all that was written so far lies.
    [[nodiscard]] const std::filesystem::path& path() const { return staging_; }

private:
    [[nodiscard]] std::vector<std::string> names() const; // sorted

    std::filesystem::path folder_;
    std::filesystem::path staging_;
    std::vector<std::filesystem::path> made_; // the innermost first
};

} // namespace relamp
