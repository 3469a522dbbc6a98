#include "scan/scan_textures.h"

#include "base/fail.h"
#include "base/parallel.h"
#include "scan/large_scan.h"
#include "scan/scan_limits.h"

#include <algorithm>
#include <span>

namespace relamp
{

int ScanTextures::pageOf(const std::string& name, const std::string& namedBy)
{
    const auto [found, isNew] = indexOf_.try_emplace(name, static_cast<int>(wanted_.size()));
    if (isNew) wanted_.push_back({name, namedBy});
    return found->second;
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
    uint64_t bytes = 0;
    std::error_code ignored;
    for (const Wanted& wanted : wanted_) {
        const auto inside = embedded.find(wanted.name);
        bytes += inside != embedded.end() ? inside->second.size()
                                          : std::filesystem::file_size(find(wanted), ignored);
    }
    PagePixels pixels(wanted_.size(), bytes, scanFile_.string());
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
        if (pixels.add(pages[i].image.pixels()) > pixelsInMemory()) spillPage(pages[i]);
        stage.advance();
    });
    return pages;
}

} // namespace relamp
