#pragma once

#include "output/staged_folder.h"
#include "relamp/progress.h"
#include "relamp/replacing.h"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace relamp
{

/// How relamp knows its own files in a folder that it fills anew.
struct FolderRules
{
    const char* list;                           // the JSON file that names them
    bool (*isOwn)(const std::string& name);     // whether it may write a file of this name
    Replacing replacing = Replacing::unchanged; // which of those that are there already
};

/// Throws Error(cannotWrite) where a ListedFolder could not be written.
void checkListedFolder(const std::filesystem::path& folder, const FolderRules& rules);

/// A folder of files that a list beside them names: it gets them all or none.
class ListedFolder
{
public:
    ListedFolder(const std::filesystem::path& folder, const FolderRules& rules, Progress& progress);

    /// Where to write the file that will be `name` in the folder.
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
    {
        return staged_ / name;
    }

    /// Writes the list, `content` and the files written so far, and moves all in; what a former
    /// list names and was not written anew goes.
    void commit(nlohmann::ordered_json content);

private:
    std::filesystem::path folder_;
    FolderRules rules_;
    Progress& progress_;
    StagedFolder staged_;
};

} // namespace relamp
