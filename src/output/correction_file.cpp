#include "output/correction_file.h"

#include "base/fail.h"
#include "output/result_folder.h"

namespace relamp
{
namespace
{

CorrectionMap correctionMapFrom(const Image& picture, const std::string& name)
{
    if (!picture.isEncoded())
        malformed(name, "must be a picture of 8 bits, as relamp wrote it; let relamp delight write "
                        "the folder anew, with --force");
    CorrectionMap map{picture.width, picture.height, std::vector<uint8_t>(picture.pixels())};
    for (size_t i = 0; i < map.share.size(); ++i) map.share[i] = picture.encoded()[3 * i];
    return map;
}

} // namespace

std::vector<CorrectionMap> readCorrection(const std::filesystem::path& folder, size_t pages)
{
    std::vector<CorrectionMap> maps;
    std::error_code ignored;
    for (size_t p = 0; p < pages; ++p) {
        const auto file = folder / nameOfLayer("correction", p, pages, "png");
        if (!std::filesystem::exists(file, ignored)) return {};
        maps.push_back(correctionMapFrom(readImage(file), file.string()));
    }
    return maps;
}

} // namespace relamp
