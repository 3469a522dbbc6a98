#pragma once

#include "relamp/progress.h"

#include <filesystem>

namespace relamp
{

/// A file that is there when it is complete, or not at all.
///
/// It is written under a hidden name beside its own and renamed by commit(). Without a commit, and
/// whatever is thrown, what was there before stays as it was and the hidden file goes.
class StagedFile
{
public:
    /// Throws Error(cannotWrite) where `file` is a folder or its folder cannot be written.
    StagedFile(const std::filesystem::path& file, Progress& progress);
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    /// Where to write it. An empty file is there already.
    [[nodiscard]] const std::filesystem::path& path() const { return staging_; }

    void commit();

private:
    std::filesystem::path file_;
    std::filesystem::path staging_;
};

} // namespace relamp
