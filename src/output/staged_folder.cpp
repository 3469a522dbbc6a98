#include "output/staged_folder.h"

#include "base/fail.h"
#include "base/file.h"

#include <algorithm>

namespace relamp
{
namespace fs = std::filesystem;
namespace
{

/// Without a trailing slash, so that it has a name and a parent.
fs::path cleaned(const fs::path& folder)
{
    if (folder.empty())
        fail(ErrorCode::cannotWrite, "the output folder", "has no name; give one with -o");
    std::error_code failure;
    const fs::path absolute = fs::absolute(folder, failure).lexically_normal();
    if (failure) cannotWrite(folder, failure.message());
    return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// Those of a folder and of what it lies in that are not there, the innermost first.
std::vector<fs::path> missing(fs::path folder)
{
    std::vector<fs::path> folders;
    std::error_code ignored;
    for (; !fs::exists(folder, ignored) && folder.has_relative_path();
         folder = folder.parent_path())
        folders.push_back(folder);
    return folders;
}

void moveFile(const fs::path& from, const fs::path& to)
{
    std::error_code failure;
    fs::rename(from, to, failure);
    if (failure) cannotWrite(to, failure.message());
}

} // namespace

StagedFolder::StagedFolder(const fs::path& folder, Progress& progress) : folder_(cleaned(folder))
{
    std::error_code failure;
    if (fs::exists(folder_, failure) && !fs::is_directory(folder_, failure))
        cannotWrite(folder_, "is a file; name another folder with -o");
    made_ = missing(folder_.parent_path());
    fs::create_directories(folder_.parent_path(), failure);
    if (failure) cannotWrite(folder_, failure.message());
    staging_ = stageFolder(folder_);
    progress.removeIfAbandoned(staging_);
}

StagedFolder::~StagedFolder()
{
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
    for (const fs::path& folder : made_) fs::remove(folder, ignored); // it is empty, or stays
}

std::vector<std::string> StagedFolder::names() const
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(staging_))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

void StagedFolder::commit(const std::string& last, const std::vector<std::string>& stale)
{
    std::error_code failure;
    if (!fs::exists(folder_, failure)) { // nothing there yet: one step, all or nothing
        moveFile(staging_, folder_);
        return;
    }
    fs::remove(folder_ / last, failure);
    const std::vector<std::string> written = names();
    for (const std::string& name : written)
        if (name != last) moveFile(staging_ / name, folder_ / name);
    for (const std::string& name : stale)
        if (!std::binary_search(written.begin(), written.end(), name))
            fs::remove(folder_ / name, failure);
    moveFile(staging_ / last, folder_ / last);
}

} // namespace relamp
