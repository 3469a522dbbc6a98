#include "output/staged_file.h"

#include "base/fail.h"
#include "base/file.h"
#include "output/folder_record.h"
#include "output/result_folder.h"

namespace relamp
{
namespace fs = std::filesystem;

StagedFile::StagedFile(const fs::path& file, Progress& progress) : file_(file)
{
    if (!file.has_filename()) cannotWrite(file, "it names a folder; name a file with -o");
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (fs::exists(status) && !fs::is_regular_file(status))
        cannotWrite(file, "is no file; name another with -o");
    const fs::path folder = file.parent_path();
    if (FolderRecord::read(folder, kReport).lists(file.filename()))
        cannotWrite(file, "it is part of what relamp delight wrote; name another file with -o");
    staging_ = stageFile(file);
    progress.removeIfAbandoned(staging_);
}

StagedFile::~StagedFile()
{
    std::error_code ignored;
    fs::remove(staging_, ignored);
}

void StagedFile::commit()
{
    std::error_code failure;
    fs::rename(staging_, file_, failure);
    if (failure) cannotWrite(file_, failure.message());
}

} // namespace relamp
