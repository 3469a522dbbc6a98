#include "scan/scan_textures.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <algorithm>
#include <span>

namespace relamp
{

int ScanTextures::pageOf(const std::string& name, const std::string& namedBy)
{
    const auto isSame = [&](const Wanted& wanted) { return wanted.name == name; };
    const auto found = std::find_if(wanted_.begin(), wanted_.end(), isSame);
    const auto index = static_cast<int>(found - wanted_.begin());
    if (found == wanted_.end()) wanted_.push_back({name, namedBy});
    return index;
}

std::filesystem::path ScanTextures::find(const Wanted& wanted) const
{
    std::string path = wanted.name;
    std::replace(path.begin(), path.end(), '\\', '/'); // written on Windows
    const std::filesystem::path asNamed = folder_ / path;
    std::error_code ignored;
    for (const auto& candidate : {asNamed, folder_ / asNamed.filename()})
        if (std::filesystem::is_regular_file(candidate, ignored) && folder_.holds(candidate))
            return candidate;
    if (std::filesystem::is_regular_file(asNamed, ignored))
        ScanFolder::refuse(fmt::format("{}: {}", scanFile_.string(), wanted.namedBy), wanted.name);
    fail(ErrorCode::cannotRead, scanFile_.string(),
         fmt::format(
             "{} names the texture \"{}\", which is not there.\nPut it beside the file, or correct "
             "the name.",
             wanted.namedBy, wanted.name));
}

std::vector<Page> ScanTextures::read(const std::map<std::string, std::vector<std::byte>>& embedded,
                                     Progress& progress) const
{
    std::vector<Page> pages(wanted_.size());
    Progress::Stage stage(progress, "read", pages.size());
    forEach(pages.size(), [&](size_t i) {
        pages[i].name = wanted_[i].name;
        const auto inside = embedded.find(wanted_[i].name);
        pages[i].image =
            inside != embedded.end()
                ? readImage(std::span(inside->second),
                            fmt::format("{}: texture \"{}\"", scanFile_.string(), wanted_[i].name),
                            transfer_)
                : readImage(find(wanted_[i]), transfer_);
        stage.advance();
    });
    return pages;
}

} // namespace relamp
