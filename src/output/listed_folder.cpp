#include "output/listed_folder.h"

#include "base/file.h"
#include "output/folder_record.h"
#include "relamp/version.h"

#include <utility>

namespace relamp
{
namespace
{

void checkOwn(const std::filesystem::path& folder, const FolderRules& rules)
{
    if (rules.replacing == Replacing::unchanged)
        checkReplaceable(folder, FolderRecord::read(folder, rules.list), rules.isOwn);
}

} // namespace

void checkListedFolder(const std::filesystem::path& folder, const FolderRules& rules)
{
    Progress nobody;
    const StagedFolder trial(folder, nobody);
    checkOwn(folder, rules);
}

ListedFolder::ListedFolder(const std::filesystem::path& folder, const FolderRules& rules,
                           Progress& progress)
    : folder_(folder), rules_(rules), progress_(progress), staged_(folder, progress)
{}

void ListedFolder::commit(nlohmann::ordered_json content)
{
    content["program"] = std::string("relamp ") + version();
    content["files"] = FolderRecord(staged_.path(), rules_.list).asJson();
    writeFile(staged_ / rules_.list,
              content.dump(1, '\t', false, nlohmann::json::error_handler_t::replace) + "\n");
    progress_.check();
    checkOwn(folder_, rules_);
    staged_.commit(rules_.list, FolderRecord::read(folder_, rules_.list).names());
}

} // namespace relamp
